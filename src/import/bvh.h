/// BVH, the text format of motion capture: a tree of joints with offsets, then a line of channel values per
/// frame.
///
/// The format has no standard; the reader accepts what common programs write: any number and order of
/// channels per joint, with rotations (degrees) multiplied in that order; position channels on any joint,
/// which replace its OFFSET; End Sites; names with spaces; keywords in any case; any line ends, tabs and
/// blank lines. One frame is one line. Unit and axes are not in the file: retarget.h finds them. bvh_write.h
/// writes BVH files.
///
/// Limits: one skeleton per file, 256 levels, 4096 joints.
#pragma once

#include <filesystem>

#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// @throws DataError naming file and line
SkeletonMotion read_bvh(const std::filesystem::path& path);
/// The same from text in memory. @param path  for messages; its stem is the motion's name
SkeletonMotion parse_bvh(std::string_view text, const std::filesystem::path& path);

}  // namespace mimicx::import
