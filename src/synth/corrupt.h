/// `mimicx corrupt`: makes a benchmark of clean motions. Each file becomes a pair
///
///     DIR/truth/NAME.npz   the motion on our own body, at 30 frames per second, on the floor z = 0
///     DIR/noisy/NAME.npz   a simulated video estimate of it, with 2D keypoints and a camera
///
/// `mimicx evaluate --truth DIR/truth --motions …` then scores methods that are given the noisy files.
/// The errors of a clip depend only on the seed and its NAME (`synth::clip_seed`), not on other files of the
/// call. The noisy file holds nothing of the truth.
///
/// What it does not do: no smoothing or repair of the truth; implausible input stays implausible.
#pragma once

#include <filesystem>
#include <string>

#include "import/motion_file.h"
#include "synth/noise/noise_model.h"

namespace mimicx::synth {

/// Converts a clip to a truth: on our own body (the nearest shape where its joints are known, else the
/// standard body where its shape is foreign), at 30 frames per second, without keypoints and other members. A
/// foreign body is put on the floor z = 0 by one shift, using a low percentile of its lowest point, unless
/// its floor is known.
/// @throws DataError for fewer than 2 frames, at its own rate or at 30, and for values that are not finite
motion::Clip benchmark_truth(const motion::Clip& input);

struct CorruptConfig {
  EstimateConfig estimate;
  std::uint64_t seed = 1;
  import::ReadConfig read;
};

/// Writes the pair of one file. @param name  NAME of the pair
/// @return the clip of the file, with the decisions of the reader
/// @throws DataError and std::invalid_argument for a file that cannot be read or corrupted
motion::Clip corrupt_file(const std::filesystem::path& file, const std::string& name,
                          const std::filesystem::path& directory, const CorruptConfig& config);

}  // namespace mimicx::synth
