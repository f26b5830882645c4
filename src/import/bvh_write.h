/// Writes a clip as BVH for other tools: y up, metres (what Blender's importer takes a unit to be), the 22
/// SMPL joint names, the T-pose of the clip's body at rest, the clip's own frame rate.
///
/// The root has position channels; every joint turns by Zrotation Yrotation Xrotation, degrees. Of the angles
/// that give the same rotation those are written that are nearest to the frame before, so curves do not jump.
/// bvh.h reads such files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::import {

/// How every file of ours begins: nine decimals, a root without an offset, and this order of channels.
inline constexpr std::string_view kBvhOpening =
    "HIERARCHY\nROOT pelvis\n{\n\tOFFSET 0.000000000 0.000000000 0.000000000\n"
    "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";

void write_bvh(const std::filesystem::path& path, const motion::Clip& clip);
/// The text `write_bvh` writes.
std::string format_bvh(const motion::Clip& clip);

}  // namespace mimicx::import
