/// What a body stands on: the convex hull of the points of its soles that touch the floor.
#pragma once

#include <vector>

#include "core/so3.h"

namespace mimicx::report {

/// Corners of a convex polygon on the floor, counter-clockwise from above, m; of one or two points these.
using Polygon = std::vector<Eigen::Vector2d>;

/// Andrew's monotone chain (A. M. Andrew, Information Processing Letters 9 (1979)).
Polygon convex_hull(Polygon points);

/// @param surface  of motion::surface_points at a frame, feet first, m
Polygon support_of(const std::vector<Vector3d>& surface);

}  // namespace mimicx::report
