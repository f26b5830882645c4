/// Finds the 22 bodies in a foreign skeleton: limbs and head by name, the trunk by the shape of the tree.
///
/// A name is split at blanks, '_', '-', '.', ':' and '|'; case does not matter. A side is a part "l", "r",
/// "left" or "right", or a prefix or suffix of a part ("LeftUpLeg", "lShldr", "UpperArm_L"). The rest must be
/// one of the words of the table in joint_names.cpp (docs/formats.md, "Joint names"); leading parts may be
/// left out ("mixamorig:LeftLeg", "Bip01 L Calf"), and digits and words of rigs behind ("thigh_l_1",
/// "l_upleg_JNT"). Of equally good names that joint counts that is below the limb's upper one and has the
/// most joints below. The pelvis is the joint where the legs meet, the chest where the arms meet, a collar
/// the joint between chest and shoulder; so spines may have any length and names.
///
/// A user's file adds names: lines `body = joint name`, with the body names of `kBodyNames`; '#' starts a
/// comment. Several lines for one body are tried in order, before the built-in words; a warning tells where a
/// skeleton has none of a body's names. A name in UTF-8 is that of a joint in Shift-JIS or GBK, too.
///
/// Where names leave a needed body without a joint, or give it an impossible one, the skeleton's shape tells
/// (skeleton_shape.h).
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "character/character.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// The user's lines: a body, and the name of a joint that may be used for it.
using NamedJoints = std::vector<std::pair<int, std::string>>;
/// @param path  for messages @throws DataError naming the line that is not of this form
NamedJoints parse_joint_map(const std::string& text, const std::filesystem::path& path);

/// @param user_map  a file of additional names; empty: none
/// @param told      gets a line where joints are matched by the skeleton's shape, and where `user_map` names
///                  joints that the skeleton does not have; may be null
/// @throws DataError where a required body has no joint, or its joint has the wrong parent
JointMap map_joints(const SkeletonMotion& motion, const std::filesystem::path& user_map = {},
                    std::vector<std::string>* told = nullptr);

}  // namespace mimicx::import
