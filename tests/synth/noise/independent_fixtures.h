/// Clips and settings for the tests of the independent noise model.
#pragma once

#include <algorithm>

#include "synth/noise/independent_noise.h"
#include "synth/noise/noise_amplitudes.h"
#include "synth/noise/noise_fixtures.h"

namespace mimicx::test {

/// A preset with a single error term and an exact camera.
inline synth::IndependentNoiseConfig only(double synth::IndependentPreset::*term, double value,
                                          std::uint64_t seed) {
  synth::IndependentNoiseConfig config;
  config.preset = {};
  if (term) config.preset.*term = value;
  config.camera = synth::camera_error("calibrated");
  config.seed = seed;
  return config;
}

/// A second and a half of walking.
inline const motion::Clip& short_walk() {
  static const motion::Clip walk = [] {
    motion::Clip clip = truth_of("walk");
    clip.rotations.resize(45);
    clip.trans.resize(45);
    return clip;
  }();
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
