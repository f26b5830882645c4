/// Data sets of synthetic motions: their clips, a simulated estimate of each, and the files.
///
/// Layout: DIR/truth/NAME.npz (exact) and DIR/noisy/NAME.npz (estimate, 2D keypoints, camera), NAME =
/// KIND_SEED. Clip i of a set has kind i mod kinds and seed K + i / kinds; its shape follows from the seed.
/// The splits differ in their seeds: 1 to 99 for the test split, 101 and higher for the training split, which
/// can have any size.
///
/// A clip depends only on its kind and seed, not on its set. Numbers are rounded to a fixed binary grid (2⁻²⁰
/// rad and m, 2⁻¹⁰ px), so that a last-bit difference between math libraries does not reach the files.
/// What it does not do: no noise of its own (estimator_noise.h), no check of feasibility.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "synth/noise/noise_model.h"
#include "synth/synthesize.h"

namespace mimicx::synth {

inline constexpr std::uint64_t kTestSeed = 1, kTrainingSeed = 101;  ///< first seeds of the two splits

struct SynthSetConfig {
  std::vector<std::string> kinds;  ///< empty: `basic_kinds()`
  int clips = 0;                   ///< 0: one of each kind
  std::uint64_t seed = kTestSeed;  ///< of the first clip of every kind
  /// A preset (`noise_preset`); "mixed": every clip draws "gvhmr", "vibe", "independent" or "none" with odds
  /// of 3 : 3 : 3 : 1, and half of the clips have no keypoints.
  std::string noise = "gvhmr";
  std::string camera = "perturbed";  ///< see `camera_error`
  motion::KeypointSet keypoints = motion::KeypointSet::kJoints22;
};

/// The clips of a set, in order.
/// @throws std::invalid_argument for an unknown kind, a kind named twice or a negative number of clips
std::vector<SynthConfig> clips_of_set(const SynthSetConfig& config);

struct SynthPair {
  motion::Clip truth, noisy;
};

/// One clip of a set, both rounded to the grid.
/// @throws std::invalid_argument for an unknown kind, noise or camera
SynthPair make_synth_pair(const SynthConfig& clip, const SynthSetConfig& config);

/// Writes the files of a set; files with other names do not change.
/// @param written  called after each clip with its index in `clips_of_set` and its truth
void write_synth_set(const std::filesystem::path& directory, const SynthSetConfig& config,
                     const std::function<void(std::size_t index, const motion::Clip& truth)>& written = {});

/// The data set in data/synthetic: test/ and train/ have one clip of every basic kind each, with the first
/// seed of the split, gvhmr noise and perturbed camera.
std::vector<std::pair<std::string, SynthSetConfig>> synthetic_splits();
/// Writes it.
void write_synthetic_data(const std::filesystem::path& directory);

}  // namespace mimicx::synth
