/// Closest points of line segments, such as the axes of capsules.
#pragma once

#include "character/character.h"

namespace mimicx::motion {

/// The closest points of two segments.
struct SegmentPair {
  Vector3d a, b;
};
/// @param a0, a1  ends of the first segment; @param b0, b1  of the second. Segments may have length 0
SegmentPair closest_points(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1);

/// The closest points of the axes of two bodies' capsules, in the world, m.
SegmentPair closest_points(const Character& character, const BodyPoses& poses, int a, int b);

}  // namespace mimicx::motion
