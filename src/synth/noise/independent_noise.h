/// A second noise model, which shares none of the keypoint fit's assumptions.
///                                                              docs/method.md, "Noise model", (4) to (15)
///
/// The first model (estimator_noise.h) and the fit share their joint weights, constant offsets of keypoints
/// in the picture, normal errors, and confidence that depends on the error. This model shares none of these,
/// so results on it predict results on other estimators better. Camera and errors follow from the seed; each
/// term has its own random stream, so that turning one off does not change the others.
///
/// What it does not do: no images; the truth is never written into the noisy clip.
#pragma once

#include "synth/noise/independent_preset.h"
#include "synth/noise/keypoint_noise.h"

namespace mimicx::synth {

struct IndependentNoiseConfig {
  IndependentPreset preset = independent_preset();
  CameraError camera =
      camera_error("perturbed");  ///< its `beta` is left out: the preset errs in shape itself
  motion::KeypointSet keypoints = motion::KeypointSet::kJoints22;
  std::uint64_t seed = 0;
};

/// As `add_noise`. @throws std::invalid_argument for fewer than 2 frames or another body model than "mimicx".
motion::Clip add_independent_noise(const motion::Clip& truth, const IndependentNoiseConfig& config);

/// The erroneous shape given to the program, by `stature` and `proportions`.
std::array<double, kBetas> mistaken_betas(const std::array<double, kBetas>& betas,
                                          const IndependentPreset& preset, std::uint64_t seed);

}  // namespace mimicx::synth
