/// Motion-X files: one npy array (frames, 322) at 30 fps, y up, SMPL-X.
///
/// Columns: 0:3 root_orient, 3:66 pose_body, 66:156 hands, 156:159 jaw, 159:209 expression, 209:309 face
/// shape, 309:312 trans, 312:322 betas. Source: github.com/IDEA-Research/Motion-X, README, "Data loading".
/// Some files of the AIST part have trans in units of 1/94 m with z negated; they are recognised by their
/// speed. Hands, jaw, expression and face shape pass through as the members pose_hand, pose_jaw, expression
/// and face_shape.
#pragma once

#include "motion/clip.h"

namespace mimicx::import {

/// The first bytes of every Motion-X file of this program, by which it recognises its own files: the header
/// has 64 blanks more than NumPy's, which readers skip.
inline constexpr std::string_view kMotionxOpening("\x93NUMPY\x01\x00\xb6\x00", 10);

inline constexpr std::size_t kMotionxColumns = 322;
/// The decision about the format, whose files tell no frame rate.
inline constexpr const char* kMotionxFormat = "format: Motion-X (30 fps, SMPL-X)";

/// @throws DataError naming the file for another shape, for text, and for numbers that are not finite
/// @param may_scale  look for the AIST scale and for centimetres; false where the user names a scale
motion::Clip motionx_from(const NpyArray& array, const std::string& name, const std::string& path,
                          bool may_scale = true);

/// (frames, 322), float64, y up. Columns of what the clip does not have are zero.
/// @throws std::invalid_argument unless the clip is at 30 fps
NpyArray to_motionx(const motion::Clip& clip);
void write_motionx(const std::filesystem::path& path, const motion::Clip& clip);

}  // namespace mimicx::import
