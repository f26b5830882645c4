/// Clips for the tests of the noise model, and how their errors spread.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "synth/noise/estimator_noise.h"
#include "synth/synthesize.h"

namespace mimicx::test {

inline constexpr double kDegree = M_PI / 180.0;

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

/// A second and a half of standing: enough for statistics over many seeds.
inline const motion::Clip& still_truth() {
  static const motion::Clip still = [] {
    motion::Clip clip = truth_of("stand");
    clip.rotations.resize(45);
    clip.trans.resize(45);
    return clip;
  }();
  return still;
}

/// No error of any kind; the tests switch on one term at a time.
inline synth::NoiseConfig silent(std::uint64_t seed = 0) {
  synth::NoiseConfig config;
  config.preset = synth::NoisePreset{};
  config.preset.slow_tau = config.preset.depth_tau = config.preset.drift_tau = 0.3;
  config.preset.jitter_frames = config.preset.depth_jitter_frames = 0.5;
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

}  // namespace mimicx::test
