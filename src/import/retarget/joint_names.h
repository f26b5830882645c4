/// Finds the 22 bodies in a foreign skeleton: limbs and head by name, the trunk by the shape of the tree.
///
/// A name is split at blanks, '_', '-', '.', ':' and '|'; letters' case does not matter. A side is a part
/// "l", "r", "left" or "right", or stands before or after the rest ("LeftUpLeg", "lShldr", "UpperArm_L").
/// What is left over must be one of the words of the table in joint_names.cpp (docs/formats.md, "Joint
/// names"), if need be without its first parts ("mixamorig:LeftLeg", "Bip01 L Calf"). The pelvis is where the
/// legs meet, the chest where the arms meet, a collar is the joint between chest and shoulder; so spines of
/// any length and name will do.
///
/// A user's file adds names: lines `body = joint name`, bodies called as in `kBodyNames`; '#' starts a
/// comment; several lines for one body are tried in turn, before the built-in words; names that a skeleton
/// does not have are ignored.
///
/// What it does not do: no guessing of limbs from geometry.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// Index of the joint that stands for each body, -1 where there is none. Hips, knees, ankles, shoulders,
/// elbows and wrists, pelvis and chest (spine3) are always there. A wrist or foot may be an end site.
using JointMap = PerBody<int>;

/// The user's lines: which body, and the name of a joint that may stand for it.
using NamedJoints = std::vector<std::pair<int, std::string>>;
/// @param path  for messages @throws DataError naming the line that is not of this form
NamedJoints parse_joint_map(const std::string& text, const std::filesystem::path& path);

/// @param user_map  a file of additional names; empty: none
/// @throws DataError when a body that must be there is not, or hangs on the wrong joint
JointMap map_joints(const SkeletonMotion& motion, const std::filesystem::path& user_map = {});

}  // namespace mimicx::import
