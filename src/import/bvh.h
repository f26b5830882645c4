/// BVH, the text format of motion capture: a tree of joints with offsets, then a line of channel values per
/// frame.
///
/// The format has no standard; the reader accepts what common programs write: any number and order of
/// channels per joint, with rotations multiplied in that order; position channels on any joint, which replace
/// its OFFSET, or are added to it where they would else put most joints at their parents; End Sites; names
/// with spaces, of any length and encoding; keywords in any case; any line ends, tabs, blank lines and lines
/// of comments ('#', '//') in front; several skeletons (person.h chooses one). One frame is one line. Unit
/// and axes are not in the file: retarget.h finds them. bvh_write.h writes BVH files.
///
/// Limits: 256 levels, 4096 joints.
#pragma once

#include <filesystem>
#include <optional>

#include "import/retarget/skeleton.h"

namespace mimicx::import {

struct BvhConfig {
  std::optional<double>
      fps;               ///< the frame rate, whatever the file's frame time says; the file need not have one
  bool radians = false;  ///< the file's rotations are radians, not degrees
};

/// @param path  for messages; its stem is the motion's name
/// @throws DataError naming file and line
SkeletonMotion parse_bvh(std::string_view text, const std::filesystem::path& path,
                         const BvhConfig& config = {});

}  // namespace mimicx::import
