/// Sample points on the surface of a character, to measure its height over the floor.      docs/metrics.md
///
/// The points lie on the collision shapes; there is no mesh. They are fixed to their bodies, because the
/// lowest point of a capsule moves on it, and rolling would look like sliding. Heel, ball and toe of each
/// foot come first (`sole_point` of the first kFootPoints contact points), then rings and tips on the
/// capsules of every other body. Between its points a rounded cap may reach lower by up to 12 % of its
/// radius.
#pragma once

#include <vector>

#include "character/character.h"
#include "character/scene.h"

namespace mimicx::motion {

struct SurfacePoint {
  int body;
  Vector3d p_B;  ///< in the body's frame, m
};

std::vector<SurfacePoint> surface_points(const Character& character);

/// World positions, in the order of the points, m.
std::vector<Vector3d> surface_positions(const std::vector<SurfacePoint>& points, const BodyPoses& poses);

/// Height of the lowest of the points over the ground under it (`Scene::clearance`), m; +∞ without points.
double lowest_height(const std::vector<Vector3d>& points, const Scene& scene = {});
/// The same for the surface points of a posed character.
double lowest_height(const std::vector<SurfacePoint>& points, const BodyPoses& poses,
                     const Scene& scene = {});
/// Height of a point of the body over the ground that it may rest on, m. On plates rest feet, pelvis and
/// thighs; hands, arms and trunk that are below the top of one are beside a seat or before a chair's back,
/// and have the floor under them.
double resting_height(int body, const Vector3d& p, const Scene& scene);
/// Lowest `resting_height` of the points of every frame.
PerFrame<double> lowest_resting_heights(const std::vector<SurfacePoint>& points,
                                        const PerFrame<BodyPoses>& poses, const Scene& scene = {});

}  // namespace mimicx::motion
