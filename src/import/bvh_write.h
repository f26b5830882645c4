/// Writes a clip as BVH for other programs: y up, metres (the unit of Blender's importer), the 22 SMPL joint
/// names, the T-pose of the clip's body as rest pose, the clip's frame rate.
///
/// The root has position channels; every joint has Zrotation Yrotation Xrotation, degrees. Several triples of
/// angles give the same rotation; the one nearest to the frame before is written, so that curves do not jump.
/// bvh.h reads BVH files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::import {

/// The first bytes of every BVH file of this program, by which it recognises its own files.
inline constexpr std::string_view kBvhOpening =
    "HIERARCHY\nROOT pelvis\n{\n\tOFFSET 0.000000000 0.000000000 0.000000000\n"
    "\tCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";

void write_bvh(const std::filesystem::path& path, const motion::Clip& clip);
/// The text of such a file.
std::string format_bvh(const motion::Clip& clip);

}  // namespace mimicx::import
