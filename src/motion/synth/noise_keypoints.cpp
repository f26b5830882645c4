#include "motion/synth/noise_keypoints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace mimicx::motion::synth {
namespace {

constexpr double kWidth = 1920.0, kHeight = 1080.0;  ///< picture, px
constexpr double kBorder = 0.05;                     ///< of the picture that stays free of the person

// Errors of a detector in units of the person's box; per axis.
constexpr double kBias = 0.007, kCorrelated = 0.001, kWhite = 0.0005, kOccluded = 0.02;
constexpr double kCorrelation = 0.6;                    ///< of the correlated part from frame to frame
constexpr double kWristNoise = 3.0;                     ///< wrists move fast and blur
constexpr double kDropShare = 0.02;                     ///< keypoints a detector misses
constexpr double kSwapRate = 0.05;                      ///< left and right of a limb mixed up, per second
constexpr double kSwapShortest = 3, kSwapLongest = 10;  ///< frames

/// A detected point: fixed to a body, mirrored by another one of the set.
struct Landmark {
  std::string name;
  int body;
  Vector3d p_B;
};

/// Where the points of COCO that are no joints lie on the head, m.
Vector3d place_on_head(const std::string& name) {
  if (name == "nose") return {0.0, 0.055, 0.100};
  const double side = name.starts_with("left_") ? 1.0 : -1.0;
  return name.ends_with("eye") ? Vector3d(side * 0.032, 0.085, 0.080) : Vector3d(side * 0.075, 0.065, 0.005);
}

std::vector<Landmark> landmarks(KeypointSet set) {
  std::vector<Landmark> points;
  for (const std::string& name : keypoint_names(set)) {
    const int body = body_of_name(name);
    points.push_back(body < 0 ? Landmark{name, kHead, place_on_head(name)}
                              : Landmark{name, body, Vector3d::Zero()});
  }
  return points;
}

/// Larger side of the box around the projected joints, px.
double box_size(const Camera& camera, const BodyPoses& poses) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& joint : poses.p_WB) {
    const Eigen::Vector2d uv = project(camera, joint).head<2>();
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  return (high - low).maxCoeff();
}

bool in_picture(const Camera& camera, const PerFrame<BodyPoses>& motion) {
  for (const BodyPoses& poses : motion)
    for (const Vector3d& joint : poses.p_WB) {
      const Vector3d seen = project(camera, joint);
      if (seen.z() < 1.0 || seen.x() < kBorder * kWidth || seen.x() > (1.0 - kBorder) * kWidth ||
          seen.y() < kBorder * kHeight || seen.y() > (1.0 - kBorder) * kHeight)
        return false;
    }
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

bool is_descendant(int body, int ancestor) {
  while (body > ancestor) body = kParents[body];
  return body == ancestor;
}

/// The other side's keypoint of the same limb, or the same index for one in the middle.
std::size_t mirror_of(const std::vector<Landmark>& points, std::size_t k) {
  std::string name = points[k].name;
  if (name.starts_with("left_"))
    name.replace(0, 5, "right_");
  else if (name.starts_with("right_"))
    name.replace(0, 6, "left_");
  const auto found =
      std::find_if(points.begin(), points.end(), [&](const Landmark& p) { return p.name == name; });
  return static_cast<std::size_t>(found - points.begin());
}

/// Left and right of both arms or both legs change places for a few frames.
void swap_sides(const std::vector<Landmark>& points, std::uint64_t seed, double fps,
                PerFrame<std::vector<Vector3d>>& uvc) {
  Random random(seed, {kSwapStream});
  for (const Interval& interval :
       poisson_intervals(random, kSwapRate, kSwapShortest, kSwapLongest, uvc.count(), fps)) {
    const int limb = random.below(2) == 0 ? kLeftHip : kLeftShoulder;
    for (int t = interval.first; t < interval.first + interval.length; ++t)
      for (std::size_t k = 0; k < points.size(); ++k)
        if (is_descendant(points[k].body, limb)) std::swap(uvc[t][k], uvc[t][mirror_of(points, k)]);
  }
}

/// 1 where a burst hides the keypoint. @return [frames][K]
PerFrame<std::vector<char>> hidden_by(const std::vector<Burst>& bursts, const std::vector<Landmark>& points,
                                      std::size_t frames) {
  PerFrame<std::vector<char>> hidden(frames, std::vector<char>(points.size(), 0));
  for (const Burst& burst : bursts)
    for (int t = burst.first; t < burst.first + burst.length; ++t)
      for (std::size_t k = 0; k < points.size(); ++k)
        if (is_descendant(points[k].body, burst.joint)) hidden[t][k] = 1;
  return hidden;
}

/// Two draws, in an order that does not depend on the compiler.
Eigen::Vector2d normal_pair(Random& random) {
  const double u = random.normal(), v = random.normal();
  return {u, v};
}

/// Errors of one keypoint over time, in units of the box, and its confidence.
PerFrame<Vector3d> detector_errors(const Landmark& point, std::size_t k, std::uint64_t seed,
                                   const PerFrame<std::vector<char>>& hidden) {
  Random still(seed, {kKeypointBiasStream, k}), random(seed, {kKeypointStream, k});
  const double factor = point.body == kLeftWrist || point.body == kRightWrist ? kWristNoise : 1.0;
  const Eigen::Vector2d bias = kBias * normal_pair(still);
  Eigen::Vector2d wandering = normal_pair(random);  // unit variance at every frame
  PerFrame<Vector3d> errors;
  for (const std::vector<char>& frame : hidden) {
    const Eigen::Vector2d white = normal_pair(random), step = normal_pair(random);
    const Eigen::Vector2d occlusion = normal_pair(random);
    const double seen = std::clamp(0.93 + 0.04 * random.normal(), 0.0, 1.0),
                 covered = random.uniform(0.2, 0.6);
    Eigen::Vector2d error = bias + factor * (kCorrelated * wandering + kWhite * white);
    if (frame[k]) error += kOccluded * occlusion;
    errors.push_back({error.x(), error.y(), frame[k] ? covered : seen});
    wandering = kCorrelation * wandering + std::sqrt(1.0 - kCorrelation * kCorrelation) * step;
  }
  return errors;
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
  const Vector3d target(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0.9);
  const double around = random.uniform(-std::numbers::pi, std::numbers::pi),
               height = random.uniform(1.2, 1.8);
  double distance = random.uniform(4.0, 6.0);
  Camera camera;
  camera.intrinsics(0, 0) = camera.intrinsics(1, 1) = kHeight * random.uniform(0.95, 1.05);
  camera.intrinsics(0, 2) = 0.5 * kWidth;
  camera.intrinsics(1, 2) = 0.5 * kHeight;
  for (; distance < 1e3; distance += 0.25) {
    const Vector3d eye(target.x() + distance * std::cos(around), target.y() + distance * std::sin(around),
                       height);
    camera.extrinsics = look_at(eye, target);
    if (in_picture(camera, truth)) return camera;
  }
  throw std::invalid_argument("place_camera: the motion does not fit into any picture");
}

Keypoints detect_keypoints(const PerFrame<BodyPoses>& truth, const Camera& camera, KeypointSet set,
                           const std::vector<Burst>& bursts, std::uint64_t seed, double fps) {
  const std::vector<Landmark> points = landmarks(set);
  const auto hidden = hidden_by(bursts, points, truth.size());
  PerFrame<double> box;
  for (const BodyPoses& poses : truth) box.push_back(box_size(camera, poses));
  Keypoints keypoints;
  keypoints.names = keypoint_names(set);
  keypoints.intrinsics = camera.intrinsics;
  keypoints.extrinsics = {camera.extrinsics};
  keypoints.uvc.assign(truth.size(), std::vector<Vector3d>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PerFrame<Vector3d> errors = detector_errors(points[k], k, seed, hidden);
    const auto& [name, body, p_B] = points[k];
    for (int t = 0; t < truth.count(); ++t) {
      const Vector3d seen = project(camera, truth[t].p_WB[body] + truth[t].q_WB[body] * p_B);
      keypoints.uvc[t][k] = {seen.x() + box[t] * errors[t].x(), seen.y() + box[t] * errors[t].y(),
                             errors[t].z()};
    }
  }
  swap_sides(points, seed, fps, keypoints.uvc);
  Random drops(seed, {kDropStream});
  for (auto& frame : keypoints.uvc)
    for (Vector3d& point : frame)
      if (drops.uniform() < kDropShare) point.setZero();
  return keypoints;
}

}  // namespace mimicx::motion::synth
