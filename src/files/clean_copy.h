/// A simulated motion in its input's format, on its input's body and, if wanted, at its input's frame rate.
///
/// A file has one body. If the input's body model is ours, that is the simulated body, also where the
/// keypoint fit changed its shape; joints, velocities and forces are kept. Otherwise the file has the input's
/// body (model and β) with the pelvis at its simulated place, whose feet may miss the floor; and members that
/// belong to the simulated body are left out. At 30 fps a copy keeps all other members of the simulated
/// motion that its format can hold. At the input's rate it has the input's frames, with rotations by slerp.
/// Torques, wrenches and rewards, which are means over simulated intervals, are then left out; hands, face
/// and eyes of the input are copied unchanged.
#pragma once

#include <filesystem>
#include <string>

#include "import/motion_file.h"

namespace mimicx::files {

/// Suffix of the copy: the input's if that format can be written, else .npz.
std::string clean_suffix(const std::filesystem::path& input);

/// A motion resampled to exactly the frames of `like`; if it ends sooner, it goes on at its last velocities.
motion::Clip at_rate_of(const motion::Clip& motion, const motion::Clip& like);

/// @param motion  file of the simulated motion @param input  the file it was made from, read with `read`
struct CleanCopy {
  std::string body;   ///< which body the copy has, in words
  double feet = 0.0;  ///< how much higher its feet are than the simulated ones on average, m
};
CleanCopy write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                           const import::ReadConfig& read, bool input_rate,
                           const std::filesystem::path& copy);

}  // namespace mimicx::files
