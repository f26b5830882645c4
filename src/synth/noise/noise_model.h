/// Simulated estimates of clean clips, as `mimicx corrupt` writes them.
///
/// What it does not do: no reading of files and no retargeting (synth/corrupt.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "synth/noise/estimator_noise.h"

namespace mimicx::synth {

/// A preset by name (`noise_preset`; "independent" without a name), with single amplitudes set by NAME=VALUE.
/// @param words  at most one name; amplitudes in any order
/// @throws std::invalid_argument for an unknown name, listing the known ones, and for an invalid value
NoisePreset noise_model(const std::vector<std::string>& words);

struct EstimateConfig {
  NoisePreset noise = noise_preset("independent");
  CameraError camera = camera_error("perturbed");
  std::optional<motion::KeypointSet> keypoints =
      motion::KeypointSet::kJoints22;  ///< none: neither detections nor a camera
};

/// @param seed  of this clip  @throws std::invalid_argument as `add_noise`
motion::Clip estimate(const motion::Clip& truth, const EstimateConfig& config, std::uint64_t seed);

/// The seed of a clip: a hash of the set's seed and the clip's name, so that a clip's errors do not depend on
/// the other clips of a call.
std::uint64_t clip_seed(std::uint64_t seed, const std::string& name);

}  // namespace mimicx::synth
