#include "motion/surface_points.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <span>

#include "core/elementary.h"

namespace mimicx::motion {
namespace {

constexpr int kRingPoints = 8;

/// Points on the half sphere at `end`, whose pole is `outward`: a ring on its rim, a staggered ring halfway
/// up, the tip.
void add_cap(std::vector<SurfacePoint>& points, int body, const Vector3d& end, const Vector3d& outward,
             double radius) {
  const Vector3d side = outward.unitOrthogonal(), other = outward.cross(side);
  for (int ring = 0; ring < 2; ++ring) {
    const double latitude = ring * std::numbers::pi / 4.0;
    for (int k = 0; k < kRingPoints; ++k) {
      const double longitude = 2.0 * std::numbers::pi * (k + 0.5 * ring) / kRingPoints;
      const Vector3d around = cos(longitude) * side + sin(longitude) * other;
      points.push_back({body, end + radius * (cos(latitude) * around + sin(latitude) * outward)});
    }
  }
  points.push_back({body, end + radius * outward});
}

}  // namespace

std::vector<SurfacePoint> surface_points(const Character& character) {
  std::vector<SurfacePoint> points;
  for (const ContactPoint& point : std::span(character.contact_points).first(kFootPoints))
    points.push_back({point.body, sole_point(point)});
  for (const Capsule& c : character.capsule) {
    if (c.body == kLeftAnkle || c.body == kRightAnkle || c.body == kLeftFoot || c.body == kRightFoot)
      continue;
    const Vector3d axis = (c.b_B - c.a_B).normalized();
    add_cap(points, c.body, c.a_B, -axis, c.radius);
    add_cap(points, c.body, c.b_B, axis, c.radius);
  }
  return points;
}

std::vector<Vector3d> surface_positions(const std::vector<SurfacePoint>& points, const BodyPoses& poses) {
  PerBody<Matrix3d> R_WB;
  for (int i = 0; i < kBodies; ++i) R_WB[i] = poses.q_WB[i].toRotationMatrix();
  std::vector<Vector3d> positions;
  positions.reserve(points.size());
  for (const SurfacePoint& point : points)
    positions.push_back(poses.p_WB[point.body] + R_WB[point.body] * point.p_B);
  return positions;
}

double lowest_height(const std::vector<Vector3d>& points, const Scene& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : points) lowest = std::min(lowest, scene.clearance(p));
  return lowest;
}

double lowest_height(const std::vector<SurfacePoint>& points, const BodyPoses& poses, const Scene& scene) {
  return lowest_height(surface_positions(points, poses), scene);
}

double resting_height(int body, const Vector3d& p, const Scene& scene) {
  constexpr std::array kResting = {kPelvis,     kLeftHip,  kRightHip, kLeftAnkle,
                                   kRightAnkle, kLeftFoot, kRightFoot};
  return std::find(kResting.begin(), kResting.end(), body) == kResting.end() ? p.z() : scene.clearance(p);
}

PerFrame<double> lowest_resting_heights(const std::vector<SurfacePoint>& points,
                                        const PerFrame<BodyPoses>& poses, const Scene& scene) {
  PerFrame<double> heights;
  for (const BodyPoses& pose : poses) {
    const std::vector<Vector3d> places = surface_positions(points, pose);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k)
      lowest = std::min(lowest, resting_height(points[k].body, places[k], scene));
    heights.push_back(lowest);
  }
  return heights;
}

}  // namespace mimicx::motion
