/// Motions of the shipped test split, for tests of other rooms.
#pragma once

#include <filesystem>

#include "motion/clip_file.h"

namespace mimicx::test {

/// The first frames of stand_1.
/// @param which  "truth", or "noisy": with its keypoints
inline motion::Clip beginning_of_stand(const char* which, std::size_t frames) {
  motion::Clip clip = motion::read_clip(std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test" /
                                        which / "stand_1.npz");
  clip.rotations.resize(frames), clip.trans.resize(frames);
  if (clip.keypoints) clip.keypoints->uvc.resize(frames);
  return clip;
}

}  // namespace mimicx::test
