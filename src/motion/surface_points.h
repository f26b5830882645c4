/// Body-fixed sample points on the surface of a character, for everything that asks how high a motion stands
/// over the floor.                                                                docs/metrics.md
///
/// There is no mesh: the points lie on the collision shapes. They are fixed to their bodies, because the
/// moving "lowest point of a capsule" would read rolling as sliding. Heel, ball and toe of each foot come
/// first (`sole_point` of the first kFootPoints contact points), then rings and tips on the capsules of every
/// other body. Between the points of a cap a rounded shape may reach lower by up to 12 % of its radius.
#pragma once

#include <vector>

#include "character/character.h"

namespace mimicx::motion {

struct SurfacePoint {
  int body;
  Vector3d p_B;  ///< in the body's frame, m
};

std::vector<SurfacePoint> surface_points(const Character& character);

/// World positions, in the order of the points, m.
std::vector<Vector3d> surface_positions(const std::vector<SurfacePoint>& points, const BodyPoses& poses);

/// Height of the lowest of some points over the floor z = 0, m; +∞ of none.
double lowest_height(const std::vector<Vector3d>& points);
/// The same of a character's surface.
double lowest_height(const std::vector<SurfacePoint>& points, const BodyPoses& poses);

}  // namespace mimicx::motion
