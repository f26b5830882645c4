#include "synth/noise/estimator_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/elementary.h"
#include "core/units.h"
#include "motion/surface_points.h"
#include "synth/min_jerk_track.h"
#include "synth/noise/estimated_motion.h"

namespace mimicx::synth {
namespace {

/// Amplitudes of an error on three time scales: constant, slow (correlated over `slow_frames`), fast.
struct ErrorScales {
  double constant, slow, slow_frames, jitter, jitter_frames;
};

/// constant·N + slow·S + jitter·J, drawn in this order.
PerFrame<double> drawn_error(Random& random, int frames, const ErrorScales& scales) {
  const double constant = scales.constant * random.normal();
  const PerFrame<double> slow = smooth_noise(random, frames, scales.slow_frames);
  const PerFrame<double> jitter = smooth_noise(random, frames, scales.jitter_frames);
  PerFrame<double> sum(slow.size());
  for (int t = 0; t < frames; ++t) sum[t] = constant + scales.slow * slow[t] + scales.jitter * jitter[t];
  return sum;
}

/// w_j: how large the error of a body's rotation relative to its parent is beside that of a knee. The ends
/// of limbs are estimated worse than the trunk.                           docs/method.md, "Noise model"
constexpr PerBody<double> kJointErrorWeight = [] {
  PerBody<double> w;
  w.fill(1.0);
  w[kLeftHip] = w[kRightHip] = 0.9;
  w[kSpine1] = w[kSpine2] = w[kSpine3] = w[kLeftCollar] = w[kRightCollar] = 0.45;
  w[kLeftAnkle] = w[kRightAnkle] = 1.3;
  w[kLeftFoot] = w[kRightFoot] = 0.6;
  w[kNeck] = w[kHead] = 0.8;
  w[kLeftShoulder] = w[kRightShoulder] = 1.2;
  w[kLeftElbow] = w[kRightElbow] = w[kLeftWrist] = w[kRightWrist] = 1.4;
  return w;
}();

using MotionRotations = PerFrame<PerBody<Quaterniond>>;

/// Item 1 of the model: errors of the joint rotations, about the child's axes.
void disturb_joints(const NoisePreset& p, std::uint64_t seed, double fps, MotionRotations& q) {
  const int frames = q.count();
  for (int body = 1; body < kBodies; ++body) {
    Random random(seed, {kJointStream, static_cast<std::uint64_t>(body)});
    Array<PerFrame<double>, 3> error;
    for (auto& axis : error)
      axis = drawn_error(random, frames,
                         {p.joint_static, p.joint_slow, p.slow_tau * fps, p.joint_jitter, p.jitter_frames});
    for (int t = 0; t < q.count(); ++t)
      q[t][body] = q[t][body] * exp_map(kJointErrorWeight[body] * kDegree *
                                        Vector3d(error[0][t], error[1][t], error[2][t]));
  }
}

/// Item 2: occlusions.
void apply_bursts(const std::vector<Burst>& bursts, MotionRotations& q) {
  for (const Burst& burst : bursts)
    for (int k = 0; k < burst.length; ++k) {
      const double window = 0.5 - 0.5 * cos(2.0 * std::numbers::pi * (k + 0.5) / burst.length);
      Quaterniond& joint = q[burst.first + k][burst.joint];
      joint = joint * exp_map(window * burst.peak);
    }
}

/// Item 3: orientation of the root, about the world's axes.
void disturb_root(const NoisePreset& p, std::uint64_t seed, double fps, MotionRotations& q) {
  const int frames = q.count();
  Random random(seed, {kRootStream}), walk(seed, {kHeadingStream});
  Array<PerFrame<double>, 3> error;
  for (auto& axis : error)
    axis = drawn_error(random, frames,
                       {p.root_static, p.root_slow, p.slow_tau * fps, p.root_jitter, p.jitter_frames});
  double heading = 0.0;
  for (int t = 0; t < q.count(); ++t) {
    const Vector3d degrees(error[0][t], error[1][t], error[2][t] + heading);
    q[t][kPelvis] = exp_map(kDegree * degrees) * q[t][kPelvis];
    heading += p.heading_walk / std::sqrt(fps) * walk.normal();
  }
}

/// Item 4: the root's path over the floor. @param depth  horizontal unit vector away from the camera
void disturb_path(const NoisePreset& p, std::uint64_t seed, double fps, const Vector3d& depth,
                  PerFrame<Vector3d>& p_root) {
  const int frames = p_root.count();
  Random path(seed, {kPathStream});
  const double scale = 1.0 + p.speed_error * path.normal();
  const Quaterniond turn = rotation_z(kDegree * p.heading_error * path.normal());
  const Vector3d start(p_root.front().x(), p_root.front().y(), 0.0);
  const auto along = [&](std::uint64_t axis) {
    Random random(seed, {kDepthStream, axis}), drifting(seed, {kDriftStream, axis});
    PerFrame<double> offset =
        drawn_error(random, frames,
                    {p.depth_static, p.depth_slow, p.depth_tau * fps, p.depth_jitter, p.depth_jitter_frames});
    const PerFrame<double> speed = smooth_noise(drifting, frames, p.drift_tau * fps);
    double drift = 0.0;
    for (int t = 0; t < frames; ++t) {
      offset[t] += drift;
      drift += p.drift * speed[t] / fps;
    }
    return offset;
  };
  const PerFrame<double> deep = along(0), lateral = along(1);
  const Vector3d across(-depth.y(), depth.x(), 0.0);
  for (int t = 0; t < frames; ++t) {
    const Vector3d travelled =
        turn * (scale * Vector3d(p_root[t].x() - start.x(), p_root[t].y() - start.y(), 0.0));
    const double height = p_root[t].z();
    p_root[t] = start + travelled + deep[t] * depth + p.lateral * lateral[t] * across;
    p_root[t].z() = height;
  }
}

/// Item 5: height. Estimators put feet on a floor, more or less, and that floor is off.
/// @param true_support  [frames] height of the lowest surface point of the truth, m
void disturb_height(const NoisePreset& p, std::uint64_t seed, double fps,
                    const PerFrame<double>& true_support, const Character& character,
                    EstimatedMotion& motion) {
  const int frames = motion.frames();
  const std::vector<motion::SurfacePoint> surface = motion::surface_points(character);
  PerFrame<double> error(motion.q.size());
  for (int t = 0; t < frames; ++t) {
    const BodyPoses poses = forward_kinematics(character, motion.p_root[t], motion.q[t]);
    error[t] = motion::lowest_height(surface, poses) - true_support[t];
  }
  if (p.snap_frames > 0.0) error = smoothed(error, p.snap_frames);
  Random random(seed, {kHeightStream});
  const PerFrame<double> offset =
      drawn_error(random, frames,
                  {p.height_static, p.height_slow, kHeightTau * fps, p.height_jitter, p.depth_jitter_frames});
  for (int t = 0; t < frames; ++t) motion.p_root[t].z() += p.height_offset + offset[t] - p.snap * error[t];
}

/// The shape with errors that is given to the program.
std::array<double, kBetas> erroneous_betas(const std::array<double, kBetas>& betas, double sigma,
                                           std::uint64_t seed) {
  Random random(seed, {kToldShapeStream});
  std::array<double, kBetas> told = betas;
  for (double& beta : told) beta = std::clamp(beta + sigma * random.normal(), -kMaxBeta, kMaxBeta);
  return told;
}

}  // namespace

NoisePreset noise_preset(std::string_view name) {
  NoisePreset p{};
  if (name == "vibe-like") {
    p.joint_static = 4.5, p.joint_slow = 4.5, p.slow_tau = 0.40, p.joint_jitter = 0.49,
    p.jitter_frames = 0.45;
    p.root_static = 1.8, p.root_slow = 1.1, p.root_jitter = 0.25, p.heading_walk = 0.0;
    p.burst_rate = 0.10, p.burst_frames_min = 3, p.burst_frames_max = 8, p.burst_min = 30, p.burst_max = 70;
    p.depth_static = 0.18, p.depth_slow = 0.045, p.depth_tau = 1.0, p.depth_jitter = 0.0016;
    p.depth_jitter_frames = 0.5, p.lateral = 0.3;
    p.drift = 0.0, p.drift_tau = 1.0, p.speed_error = 0.0, p.heading_error = 0.0;
    p.snap = 0.9, p.snap_frames = 0.0;
    p.height_offset = -0.0095, p.height_static = 0.003, p.height_slow = 0.003, p.height_jitter = 0.0012;
    return p;
  }
  if (name == "gvhmr-like") {
    p.joint_static = 3.8, p.joint_slow = 2.6, p.slow_tau = 0.95, p.joint_jitter = 0.15, p.jitter_frames = 0.6;
    p.root_static = 2.1, p.root_slow = 1.0, p.root_jitter = 0.07, p.heading_walk = 0.3;
    p.burst_rate = 0.02, p.burst_frames_min = 8, p.burst_frames_max = 16, p.burst_min = 10, p.burst_max = 30;
    p.depth_static = 0.245, p.depth_slow = 0.0, p.depth_tau = 1.0, p.depth_jitter = 0.0003;
    p.depth_jitter_frames = 1.5, p.lateral = 0.6;
    p.drift = 0.015, p.drift_tau = 1.5, p.speed_error = 0.03, p.heading_error = 2.0;
    p.snap = 0.5, p.snap_frames = 4.0;
    p.height_offset = 0.064, p.height_static = 0.070, p.height_slow = 0.030, p.height_jitter = 0.0002;
    return p;
  }
  throw std::invalid_argument("noise_preset: unknown preset '" + std::string(name) + "'");
}

std::vector<Burst> draw_bursts(const NoisePreset& preset, std::uint64_t seed, int frames, double fps) {
  static constexpr Array<int, 12> kLimbs = {kLeftHip,   kRightHip,   kLeftKnee,     kRightKnee,
                                            kLeftAnkle, kRightAnkle, kLeftShoulder, kRightShoulder,
                                            kLeftElbow, kRightElbow, kLeftWrist,    kRightWrist};
  Random random(seed, {kBurstStream});
  std::vector<Burst> bursts;
  for (const Interval& interval : poisson_intervals(random, preset.burst_rate, preset.burst_frames_min,
                                                    preset.burst_frames_max, frames, fps)) {
    const int joint = kLimbs[random.below(kLimbs.size())];
    Vector3d axis;
    for (double& component : axis) component = random.normal();
    const double size = kDegree * random.uniform(preset.burst_min, preset.burst_max);
    bursts.push_back({joint, interval.first, interval.length, size * axis.normalized()});
  }
  return bursts;
}

motion::Clip add_noise(const motion::Clip& truth, const NoiseConfig& config) {
  if (truth.frames() < 2) throw std::invalid_argument("add_noise: at least 2 frames are needed");
  if (truth.body_model != "mimicx") throw std::invalid_argument("add_noise: the body model must be 'mimicx'");
  const NoisePreset& preset = config.preset;
  const std::uint64_t seed = config.seed;
  const Vector3d rest = mimicx::rest_pelvis(truth.body_model);
  const Character character = make_character(truth.betas);
  const std::vector<motion::SurfacePoint> surface = motion::surface_points(character);
  EstimatedMotion motion;
  motion.q.resize(truth.rotations.size());
  PerFrame<BodyPoses> poses;
  PerFrame<double> support;
  for (int t = 0; t < motion.frames(); ++t) {
    for (int b = 0; b < kBodies; ++b) motion.q[t][b] = exp_map(truth.rotations[t][b]);
    motion.p_root.push_back(truth.trans[t] + rest);
    poses.push_back(forward_kinematics(character, motion.p_root[t], motion.q[t]));
    support.push_back(motion::lowest_height(surface, poses[t]));
  }
  const CameraPath camera =
      config.camera.moving ? carry_camera(poses, seed, truth.fps) : CameraPath(place_camera(poses, seed));
  const std::vector<Burst> bursts = draw_bursts(preset, seed, truth.frames(), truth.fps);

  motion::Clip noisy;
  noisy.name = truth.name;
  noisy.fps = truth.fps;
  noisy.gender = truth.gender;
  noisy.betas = erroneous_betas(truth.betas, config.camera.beta, seed);
  disturb_joints(preset, seed, truth.fps, motion.q);
  apply_bursts(bursts, motion.q);
  disturb_root(preset, seed, truth.fps, motion.q);
  const Vector3d view = camera.extrinsics.front().block<1, 3>(2, 0).transpose();
  disturb_path(preset, seed, truth.fps, Vector3d(view.x(), view.y(), 0.0).normalized(), motion.p_root);
  disturb_height(preset, seed, truth.fps, support, make_character(noisy.betas), motion);
  noisy.rotations.resize(motion.q.size());
  for (int t = 0; t < motion.frames(); ++t) {
    for (int b = 0; b < kBodies; ++b) noisy.rotations[t][b] = log_map(motion.q[t][b]);
    noisy.trans.push_back(motion.p_root[t] - rest);
  }
  noisy.keypoints = detect_keypoints(poses, camera, config.keypoints, bursts, seed, truth.fps);
  const CameraPath told = erroneous_camera(camera, config.camera, seed, truth.fps);
  noisy.keypoints->intrinsics = told.intrinsics;
  noisy.keypoints->extrinsics = told.extrinsics;
  return noisy;
}

}  // namespace mimicx::synth
