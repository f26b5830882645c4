#include "synth/noise/hand_held_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/elementary.h"
#include "core/units.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {
namespace {

constexpr double kWidth = 1920.0, kHeight = 1080.0;      ///< picture, px
constexpr double kBorder = 0.05;                         ///< of the picture that stays free of the person
constexpr double kFarthest = 1e3, kDistanceStep = 0.25;  ///< m
constexpr double kAimHeight = 0.9;                       ///< of the point a standing camera looks at, m

// Somebody who carries a camera: times in s, lengths in m, angles in degrees.
constexpr double kFollowTau = 0.5;                   ///< how late and how smoothly it follows the person
constexpr double kWalk = 0.25, kWalkTau = 2.5;       ///< of the feet
constexpr double kSway = 0.015, kSwayTau = 0.4;      ///< of the arms
constexpr double kWander = 1.2, kWanderTau = 0.9;    ///< of the direction
constexpr double kTremor = 0.12, kTremorTau = 0.08;  ///< of the hands
constexpr double kCarryDriftTau = 0.5;               ///< of the velocity of what drifts

bool in_picture(const Camera& camera, const BodyPoses& poses) {
  for (const Vector3d& joint : poses.p_WB) {
    const Vector3d seen = project(camera, joint);
    if (seen.z() < 1.0 || seen.x() < kBorder * kWidth || seen.x() > (1.0 - kBorder) * kWidth ||
        seen.y() < kBorder * kHeight || seen.y() > (1.0 - kBorder) * kHeight)
      return false;
  }
  return true;
}

bool in_picture(const CameraPath& camera, const PerFrame<BodyPoses>& motion) {
  for (int t = 0; t < motion.count(); ++t)
    if (!in_picture(camera.at(t), motion[t])) return false;
  return true;
}

/// Looks from `eye` at `target`, the horizon level.
Eigen::Matrix4d look_at(const Vector3d& eye, const Vector3d& target) {
  const Vector3d forward = (target - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix4d world_to_camera = Eigen::Matrix4d::Identity();
  world_to_camera.block<1, 3>(0, 0) = right.transpose();
  world_to_camera.block<1, 3>(1, 0) = forward.cross(right).transpose();
  world_to_camera.block<1, 3>(2, 0) = forward.transpose();
  world_to_camera.block<3, 1>(0, 3) = -world_to_camera.block<3, 3>(0, 0) * eye;
  return world_to_camera;
}

Matrix3d drawn_intrinsics(Random& random) {
  Matrix3d intrinsics = Matrix3d::Identity();
  intrinsics(0, 0) = intrinsics(1, 1) = kHeight * random.uniform(0.95, 1.05);
  intrinsics(0, 2) = 0.5 * kWidth;
  intrinsics(1, 2) = 0.5 * kHeight;
  return intrinsics;
}

[[noreturn]] void refuse_motion() {
  throw std::invalid_argument("place_camera: the motion does not fit into any picture");
}

/// Three independent smooth walks that begin at 0.
PerFrame<Vector3d> drifting(Random& random, int frames, double size, double fps) {
  PerFrame<Vector3d> out(frames, Vector3d::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const PerFrame<double> walk = smooth_walk(random, frames, kCarryDriftTau, fps);
    for (int t = 0; t < frames; ++t) out[t][axis] = size * walk[t];
  }
  return out;
}

/// The path of the pelvis that the camera follows: smoothed, its ends held.
PerFrame<Vector3d> followed(const PerFrame<BodyPoses>& truth, double fps) {
  PerFrame<Vector3d> path;
  const double frames = kFollowTau * fps;
  const int radius = static_cast<int>(std::ceil(3.0 * frames));
  for (int t = 0; t < truth.count(); ++t) {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    for (int k = -radius; k <= radius; ++k) {
      const double weight = exp(-0.5 * k * k / (frames * frames));
      sum += weight * truth[std::clamp(t + k, 0, truth.count() - 1)].p_WB[kPelvis];
      weights += weight;
    }
    path.push_back(sum / weights);
  }
  return path;
}

/// About its own axes; it stays where it is, so translation turns with it.
Eigen::Matrix4d turned(const Eigen::Matrix4d& extrinsics, const Vector3d& rotation) {
  Eigen::Matrix4d out = extrinsics;
  out.topRows<3>() = exp_map(rotation).toRotationMatrix() * extrinsics.topRows<3>();
  return out;
}

}  // namespace

Vector3d project(const Camera& camera, const Vector3d& p_W) {
  const Vector3d p_C = camera.extrinsics.block<3, 3>(0, 0) * p_W + camera.extrinsics.block<3, 1>(0, 3);
  const Vector3d pixel = camera.intrinsics * p_C;
  return {pixel.x() / pixel.z(), pixel.y() / pixel.z(), p_C.z()};
}

Camera place_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed) {
  Random random(seed, {kCameraStream});
  Vector3d low = truth.front().p_WB[kPelvis], high = low;
  for (const BodyPoses& poses : truth) {
    low = low.cwiseMin(poses.p_WB[kPelvis]);
    high = high.cwiseMax(poses.p_WB[kPelvis]);
  }
  const Vector3d target(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), kAimHeight);
  const double around = random.uniform(-std::numbers::pi, std::numbers::pi),
               height = random.uniform(1.2, 1.8);
  double distance = random.uniform(4.0, 6.0);
  Camera camera;
  camera.intrinsics = drawn_intrinsics(random);
  for (; distance < kFarthest; distance += kDistanceStep) {
    const Vector3d eye(target.x() + distance * cos(around), target.y() + distance * sin(around), height);
    camera.extrinsics = look_at(eye, target);
    if (in_picture(camera, truth)) return camera;
  }
  refuse_motion();
}

CameraPath carry_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed, double fps) {
  const int frames = truth.count();
  Random random(seed, {kCarriedCameraStream}), hands(seed, {kHandStream});
  const double around = random.uniform(-std::numbers::pi, std::numbers::pi),
               height = random.uniform(1.3, 1.7);
  double distance = random.uniform(3.5, 5.5);
  CameraPath camera;
  camera.intrinsics = drawn_intrinsics(random);
  const PerFrame<Vector3d> aim = followed(truth, fps);
  const PerFrame<Vector3d> walk = smooth_errors(hands, frames, kWalk, kWalkTau * fps),
                           sway = smooth_errors(hands, frames, kSway, kSwayTau * fps),
                           wander = smooth_errors(hands, frames, kWander, kWanderTau * fps),
                           tremor = smooth_errors(hands, frames, kTremor, kTremorTau * fps);
  const Vector3d centre = 0.5 * (aim.front() + aim.back());
  for (; distance < kFarthest; distance += kDistanceStep) {
    const Vector3d place(centre.x() + distance * cos(around), centre.y() + distance * sin(around), height);
    camera.extrinsics.clear();
    for (int t = 0; t < frames; ++t) {
      const Vector3d eye = place + Vector3d(walk[t].x(), walk[t].y(), 0.0) + sway[t];
      camera.extrinsics.push_back(turned(look_at(eye, aim[t]), kDegree * (wander[t] + tremor[t])));
    }
    if (in_picture(camera, truth)) return camera;
  }
  refuse_motion();
}

CameraError camera_error(std::string_view name) {
  if (name == "calibrated") return {};
  if (name == "perturbed") return {.focal = 0.01, .tilt = 0.3};
  if (name == "wild") return {.focal = 0.05, .tilt = 0.7};
  if (name == "moving")
    return {.focal = 0.01, .tilt = 0.3, .moving = true, .turn_drift = 0.2, .place_drift = 0.015};
  throw std::invalid_argument("camera_error: unknown camera '" + std::string(name) + "'");
}

CameraPath erroneous_camera(const CameraPath& camera, const CameraError& error, std::uint64_t seed,
                            double fps) {
  Random random(seed, {kToldCameraStream});
  const double focal = 1.0 + error.focal * random.normal();
  const Vector3d tilt = kDegree * error.tilt * random.normal() * Vector3d::UnitX();
  CameraPath told = camera;
  told.intrinsics(0, 0) *= focal;
  told.intrinsics(1, 1) *= focal;
  for (Eigen::Matrix4d& extrinsics : told.extrinsics) extrinsics = turned(extrinsics, tilt);
  if (!camera.is_moving()) return told;
  Random drift(seed, {kToldDriftStream});
  const int frames = camera.extrinsics.count();
  const PerFrame<Vector3d> turn = drifting(drift, frames, error.turn_drift, fps),
                           shift = drifting(drift, frames, error.place_drift, fps);
  for (int t = 0; t < frames; ++t) {
    Eigen::Matrix4d& extrinsics = told.extrinsics[t];
    extrinsics = turned(extrinsics, kDegree * turn[t]);
    extrinsics.block<3, 1>(0, 3) -= extrinsics.block<3, 3>(0, 0) * shift[t];
  }
  return told;
}

}  // namespace mimicx::synth
