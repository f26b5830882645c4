/// Clips for the tests of the noise model, and how their errors spread.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/units.h"
#include "synth/noise/estimator_noise.h"
#include "synth/synthesize.h"

namespace mimicx::test {

inline PerBody<Quaterniond> rotations_of(const motion::Clip& clip, std::size_t t) {
  PerBody<Quaterniond> q;
  for (std::size_t b = 0; b < kBodies; ++b) q[b] = exp_map(clip.rotations[t][b]);
  return q;
}

inline PerFrame<BodyPoses> poses_of_clip(const motion::Clip& clip) {
  const Character character = make_character(clip.betas);
  PerFrame<BodyPoses> poses;
  for (std::size_t t = 0; t < clip.rotations.size(); ++t)
    poses.push_back(forward_kinematics(character, clip.trans[t] + mimicx::rest_pelvis(clip.body_model),
                                       rotations_of(clip, t)));
  return poses;
}

inline const motion::Clip& truth_of(const std::string& kind) {
  static std::map<std::string, motion::Clip> cache;
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 5;
  const auto [entry, is_new] = cache.try_emplace(kind);
  if (is_new) entry->second = synth::synthesize(config);
  return entry->second;
}

/// The first frames of a motion: few suffice for statistics over many seeds.
inline motion::Clip beginning_of(const std::string& kind, std::size_t frames) {
  motion::Clip clip = truth_of(kind);
  clip.rotations.resize(frames);
  clip.trans.resize(frames);
  return clip;
}

/// A second and a half of standing.
inline const motion::Clip& still_truth() {
  static const motion::Clip still = beginning_of("stand", 45);
  return still;
}

/// A preset with a single error term and an exact camera.
inline synth::NoiseConfig only(double synth::NoisePreset::*term, double value, std::uint64_t seed) {
  synth::NoiseConfig config;
  config.preset = {};
  if (term) config.preset.*term = value;
  config.camera = synth::camera_error("calibrated");
  config.seed = seed;
  return config;
}

/// Root mean square of samples that should have mean 0.
struct Spread {
  double squares = 0.0, sum = 0.0;
  int count = 0;
  void add(double x) { squares += x * x, sum += x, ++count; }
  double rms() const { return std::sqrt(squares / count); }
  double mean() const { return sum / count; }
};

inline Vector3d camera_position(const motion::Keypoints& k) {
  const Eigen::Matrix4d& E = k.extrinsics.front();
  return -E.block<3, 3>(0, 0).transpose() * E.block<3, 1>(0, 3);
}
inline Vector3d viewing_direction(const motion::Keypoints& k) {
  return k.extrinsics.front().block<1, 3>(2, 0).transpose();
}

/// A second and a half of walking.
inline const motion::Clip& short_walk() {
  static const motion::Clip walk = beginning_of("walk", 45);
  return walk;
}

/// Error of one joint about its parent's axes, degrees.
inline Vector3d joint_error(const motion::Clip& truth, const motion::Clip& noisy, int t, int body) {
  return log_map(exp_map(noisy.rotations[t][body]) * exp_map(truth.rotations[t][body]).conjugate()) / kDegree;
}

/// The value that a share of the samples lies under.
inline double share_below(std::vector<double> samples, double share) {
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size()));
  std::nth_element(samples.begin(), at, samples.end());
  return *at;
}

/// u, v by the 3 × 4 projection matrix of the camera of a frame: an oracle that shares no code with
/// `project`.
inline Eigen::Vector2d pinhole(const motion::Keypoints& k, int t, const Vector3d& p_W) {
  const Eigen::Matrix4d& E = k.extrinsics[k.extrinsics.count() > 1 ? t : 0];
  const Eigen::Matrix<double, 3, 4> projection = k.intrinsics * E.topRows<3>();
  return (projection * p_W.homogeneous()).hnormalized();
}

}  // namespace mimicx::test
