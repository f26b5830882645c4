/// A simulated motion for the tools its input came from: the input's format, body and, if wanted, frame rate.
///
/// One body per file. Where the input's body is the simulated one, or a body of ours that the keypoint fit
/// gave another shape, it is the simulated one, and joints, velocities and forces belong to it. Else the file
/// names the body as the input did (body model and β), with the pelvis where the simulation had it, and
/// members that belong to the simulated body stay out. At 30 fps a copy holds all other members of the
/// simulated motion that its format has a place for. At the input's rate it has the input's frames, rotations
/// by slerp; torques, wrenches and rewards are means over intervals of the simulation and stay out, and what
/// the input held beside the body (hands, face, eyes) comes along untouched.
#pragma once

#include <filesystem>
#include <string>

#include "import/motion_file.h"

namespace mimicx::files {

/// Suffix of the copy: the input's own where motions are written so, else .npz.
std::string clean_suffix(const std::filesystem::path& input);

/// A motion at another rate with exactly the frames of `like`; the last frame is held where it ends sooner.
motion::Clip at_rate_of(const motion::Clip& motion, const motion::Clip& like);

/// @param motion  file of the simulated motion @param input  the file it was made from, read with `read`
/// @return whose body it is, in words
std::string write_clean_copy(const std::filesystem::path& motion, const std::filesystem::path& input,
                             const import::ReadConfig& read, bool input_rate,
                             const std::filesystem::path& copy);

}  // namespace mimicx::files
