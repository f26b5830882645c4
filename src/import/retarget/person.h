/// The skeleton of the person in a file that has several: two people, or a person and a prop.
#pragma once

#include <filesystem>
#include <string>

#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// @param motion     of one or more skeletons
/// @param root       name or number (from 1) of the root to take; empty: that of the only person
/// @param joint_map  additional joint names (joint_names.h); empty: none
/// @return the motion of one skeleton; a decision names the others
/// @throws DataError where no root has this name, or several skeletons are people and `root` is empty
SkeletonMotion person_of(const SkeletonMotion& motion, const std::string& root,
                         const std::filesystem::path& joint_map);

}  // namespace mimicx::import
