/// The distance of two line segments.
#pragma once

#include "motion/closest_points.h"

namespace mimicx::motion {

inline double segment_distance(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0,
                               const Vector3d& b1) {
  const SegmentPair near = closest_points(a0, a1, b0, b1);
  return (near.a - near.b).norm();
}

}  // namespace mimicx::motion
