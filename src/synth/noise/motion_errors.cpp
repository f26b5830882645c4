#include "synth/noise/motion_errors.h"

#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/units.h"
#include "motion/surface_points.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

// Time constants, s, and frequencies, Hz.
constexpr double kJointTau = 1.2, kStrideTau = 2.0, kDriftTau = 2.5, kTurnTau = 1.0;
constexpr double kSlowestWobble = 0.3, kFastestWobble = 0.7;
constexpr int kStaticFreedom = 4;  ///< of Student's t of the constant errors

/// Vector of three drawn numbers, x first.
template <class Draw>
Vector3d drawn_vector(Draw draw) {
  const double x = draw(), y = draw(), z = draw();
  return {x, y, z};
}

/// A person's constant error: Student's t of unit variance.
double constant_error(Random& random) {
  constexpr double kVariance = kStaticFreedom / (kStaticFreedom - 2.0);
  return student_t(random, kStaticFreedom) / std::sqrt(kVariance);
}

/// A slow oscillation of unit mean square, per axis of its own frequency and phase.
PerFrame<Vector3d> oscillation(Random& random, int count, double size, double fps) {
  PerFrame<Vector3d> out(count, Vector3d::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const double frequency = random.uniform(kSlowestWobble, kFastestWobble),
                 phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    for (int t = 0; t < count; ++t)
      out[t][axis] = size * std::numbers::sqrt2 * sin(2.0 * std::numbers::pi * frequency * t / fps + phase);
  }
  return out;
}

void disturb_joint(const NoisePreset& p, std::uint64_t seed, double fps, int body, EstimatedMotion& motion) {
  const auto key = static_cast<std::uint64_t>(body);
  const int frames = motion.q.count();
  Random still(seed, {kJointConstantStream, key}), slow(seed, {kJointSlowStream, key}),
      quick(seed, {kJointJitterStream, key});
  const double weight = kDegree * joint_error_weight(body);
  const Vector3d constant = p.joint_static * drawn_vector([&] { return constant_error(still); });
  const PerFrame<Vector3d> slowly = smooth_errors(slow, frames, p.joint_slow, kJointTau * fps),
                           quickly = smooth_errors(quick, frames, p.joint_jitter, p.jitter_frames);
  for (int t = 0; t < frames; ++t) {
    Quaterniond& joint = motion.q[t][body];
    if (p.joint_shrink != 0.0) joint = exp_map((1.0 - p.joint_shrink) * log_map(joint));
    joint = exp_map(weight * (constant + slowly[t] + quickly[t])) * joint;
  }
}

}  // namespace

void disturb_rotations(const NoisePreset& p, std::uint64_t seed, double fps, EstimatedMotion& motion) {
  for (int body = 1; body < kBodies; ++body) disturb_joint(p, seed, fps, body, motion);
  Random still(seed, {kRootConstantStream}), wobbling(seed, {kWobbleTurnStream});
  const Quaterniond constant =
      exp_map(kDegree * p.root_static * drawn_vector([&] { return constant_error(still); }));
  const PerFrame<Vector3d> wobble = oscillation(wobbling, motion.q.count(), p.wobble_turn, fps);
  for (int t = 0; t < motion.q.count(); ++t)
    motion.q[t][kPelvis] = exp_map(kDegree * wobble[t]) * motion.q[t][kPelvis] * constant;
}

void disturb_travel(const NoisePreset& p, std::uint64_t seed, double fps, EstimatedMotion& motion) {
  const int frames = motion.q.count();
  Random stride(seed, {kStrideStream}), drift(seed, {kFalseVelocityStream}), turn(seed, {kHeadingWalkStream});
  const PerFrame<double> scale = smooth_error(stride, frames, p.stride, kStrideTau * fps),
                         forward = smooth_error(drift, frames, p.drift, kDriftTau * fps),
                         sideways = smooth_error(drift, frames, p.drift, kDriftTau * fps),
                         heading = smooth_walk(turn, frames, kTurnTau, fps);
  Vector3d before = motion.p_root.front(), place = before;
  for (int t = 0; t < frames; ++t) {
    const Quaterniond turned = rotation_z(kDegree * p.turn_drift * heading[t]);
    Vector3d step = motion.p_root[t] - before;
    before = motion.p_root[t];
    const double height = before.z();
    step.z() = 0.0;
    motion.q[t][kPelvis] = turned * motion.q[t][kPelvis];
    if (t > 0) {
      const Vector3d velocity(forward[t], sideways[t], 0.0);
      place += (1.0 + scale[t]) * (turned * step) +
               rotation_z(heading_angle(motion.q[t][kPelvis])) * velocity / fps;
    }
    motion.p_root[t] = {place.x(), place.y(), height};
  }
}

void disturb_place(const NoisePreset& p, std::uint64_t seed, double fps, const CameraPath& camera,
                   EstimatedMotion& motion) {
  Random distance(seed, {kDistanceStream}), height(seed, {kFloorStream}), wobbling(seed, {kWobbleStream});
  const Vector3d ray = motion.p_root.front() - motion::eye_of(camera.at(0).extrinsics);
  const Vector3d offset = p.depth * distance.normal() * ray + p.height * height.normal() * Vector3d::UnitZ();
  const PerFrame<Vector3d> wobble = oscillation(wobbling, motion.p_root.count(), p.wobble, fps);
  for (int t = 0; t < motion.p_root.count(); ++t) motion.p_root[t] += offset + wobble[t];
}

void put_on_floor(const NoisePreset& p, const Character& mistaken, const Character& body,
                  const PerFrame<BodyPoses>& truth, EstimatedMotion& motion) {
  if (p.snap == 0.0) {
    for (Vector3d& p_root : motion.p_root) p_root.z() += p.height_offset;
    return;
  }
  const std::vector<motion::SurfacePoint> points = motion::surface_points(mistaken),
                                          true_points = motion::surface_points(body);
  for (int t = 0; t < motion.frames(); ++t) {
    const double height = motion::lowest_height(points,
                                                forward_kinematics(mistaken, motion.p_root[t], motion.q[t])),
                 true_height = motion::lowest_height(true_points, truth[t]);
    motion.p_root[t].z() += p.height_offset - p.snap * (height - true_height);
  }
}

}  // namespace mimicx::synth
