/// The noise model: turns a clean clip into a "video-recovered" one with the errors of a video estimator,
/// 2D keypoints and a camera.                                   docs/method.md, "Noise model", (4) to (16)
///
/// Its distributions are not those that the keypoint fit assumes: other joint weights, heavy tails, keypoints
/// that turn with limb and view, a confidence that does not tell the error. Camera and errors follow from the
/// seed; each term has its own random stream, so that turning one off does not change the others.
///
/// What it does not do: no images; the truth is never written into the noisy clip.
#pragma once

#include "synth/noise/keypoint_noise.h"
#include "synth/noise/noise_preset.h"

namespace mimicx::synth {

struct NoiseConfig {
  NoisePreset preset = noise_preset("independent");
  CameraError camera = camera_error("perturbed");
  motion::KeypointSet keypoints = motion::KeypointSet::kJoints22;
  std::uint64_t seed = 0;
};

/// The simulated estimate of a clean clip of body model "mimicx": rotations, trans and β with errors,
/// keypoints of the clean motion with detection errors, and a camera with errors.
/// @throws std::invalid_argument for fewer than 2 frames or another body model
motion::Clip add_noise(const motion::Clip& truth, const NoiseConfig& config);

/// The erroneous shape given to the program, by `stature` and `proportions`.
std::array<double, kBetas> mistaken_betas(const std::array<double, kBetas>& betas, const NoisePreset& preset,
                                          std::uint64_t seed);

}  // namespace mimicx::synth
