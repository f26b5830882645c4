/// Finds the 22 bodies in a skeleton by its shape, where names do not tell them: two pairs of limbs that
/// mirror each other in the lengths of their bones, the longer one the legs; knees and elbows where two long
/// bones meet; the head on the chain between the arms. Left and right come from signs in the names ("L",
/// "left", "左"), else from where toes point and knees bend.
#pragma once

#include <optional>

#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// @return limbs, neck and head; pelvis, chest and collars are -1. None where the skeleton has no such limbs
std::optional<JointMap> map_by_shape(const SkeletonMotion& motion);

}  // namespace mimicx::import
