/// Line segments, such as the axes of capsules.
#pragma once

#include "character/character.h"

namespace mimicx::motion {

/// The points of two segments that are nearest to each other.
struct SegmentPair {
  Vector3d a, b;
};
/// @param a0,a1  ends of the one; @param b0,b1  of the other; an end may be both ends
SegmentPair closest_points(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1);

/// The same of the axes of two bodies' capsules, in the world.
SegmentPair closest_points(const Character& character, const BodyPoses& poses, int a, int b);

}  // namespace mimicx::motion
