/// The support polygon: the convex hull of the sole points that touch the floor.
#pragma once

#include <vector>

#include "character/scene.h"

namespace mimicx::report {

/// Corners of a convex polygon on the floor, counter-clockwise from above, m. May have one or two points.
using Polygon = std::vector<Eigen::Vector2d>;

/// Andrew's monotone chain (A. M. Andrew, Information Processing Letters 9 (1979)).
Polygon convex_hull(Polygon points);

/// @param surface  motion::surface_points of a frame, feet first, m
Polygon support_of(const std::vector<Vector3d>& surface, const Scene& scene = {});

}  // namespace mimicx::report
