/// `mimicx corrupt`: a benchmark out of anyone's clean motion. Each file becomes a pair
///
///     DIR/truth/NAME.npz   the motion on our own body, at 30 frames per second, on the floor z = 0
///     DIR/noisy/NAME.npz   what a video estimator might make of it, with 2D keypoints and a camera
///
/// so that `mimicx evaluate --truth DIR/truth --motions …` scores whatever is done with the second.
/// The errors of a clip follow from the seed and its NAME alone (`synth::clip_seed`): the other files
/// of a call change nothing. The noisy file holds nothing of the truth.
///
/// What it does not do: no smoothing or repair of the truth; a motion that no body can do stays one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/motion_file.h"
#include "synth/noise/noise_model.h"

namespace mimicx::synth {

/// A clip as a truth: on our own body (the standard one where its shape means nothing here, the nearest one
/// where its joints are known), 30 frames per second, without keypoints and other members. A foreign body is
/// put on the floor z = 0 as a whole, by the low percentile of its lowest point, unless its floor is known.
/// @throws DataError for fewer than 2 frames, at its own rate or at 30, and for values that are not finite
motion::Clip benchmark_truth(const motion::Clip& input);

struct CorruptConfig {
  EstimateConfig estimate;
  std::uint64_t seed = 1;
  import::ReadConfig read;
};

/// Writes the pair of one file. @param name  NAME of the pair
/// @return the file as it was read, with what reading decided
/// @throws DataError and std::invalid_argument for a file that cannot be read or corrupted
motion::Clip corrupt_file(const std::filesystem::path& file, const std::string& name,
                          const std::filesystem::path& directory, const CorruptConfig& config);

}  // namespace mimicx::synth
