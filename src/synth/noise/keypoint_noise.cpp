#include "synth/noise/keypoint_noise.h"

#include <algorithm>
#include <cmath>

#include "synth/noise/detected_points.h"

namespace mimicx::synth {
namespace {

// Errors of a detector in units of the person's box; per axis.
constexpr double kBias = 0.007, kCorrelated = 0.001, kWhite = 0.0005, kOccluded = 0.02;
constexpr double kCorrelation = 0.6;                    ///< of the correlated part from frame to frame
constexpr double kWristNoise = 3.0;                     ///< wrists move fast and blur
constexpr double kDropShare = 0.02;                     ///< keypoints a detector misses
constexpr double kSwapRate = 0.05;                      ///< left and right of a limb mixed up, per second
constexpr double kSwapShortest = 3, kSwapLongest = 10;  ///< frames

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

motion::Keypoints detect_keypoints(const PerFrame<BodyPoses>& truth, const CameraPath& camera,
                                   motion::KeypointSet set, const std::vector<Burst>& bursts,
                                   std::uint64_t seed, double fps) {
  const std::vector<Landmark> points = landmarks(set);
  const auto hidden = hidden_by(bursts, points, truth.size());
  PerFrame<double> box;
  for (int t = 0; t < truth.count(); ++t) box.push_back(box_size(camera.at(t), truth[t]));
  motion::Keypoints keypoints;
  keypoints.names = motion::keypoint_names(set);
  keypoints.intrinsics = camera.intrinsics;
  keypoints.extrinsics = camera.extrinsics;
  keypoints.uvc.assign(truth.size(), std::vector<Vector3d>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PerFrame<Vector3d> errors = detector_errors(points[k], k, seed, hidden);
    const auto& [name, body, p_B] = points[k];
    for (int t = 0; t < truth.count(); ++t) {
      const Vector3d seen = project(camera.at(t), truth[t].p_WB[body] + truth[t].q_WB[body] * p_B);
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

}  // namespace mimicx::synth
