#include "control/cost/legs_in_boxes.h"

#include <algorithm>

#include "physics/lanes.h"

namespace mimicx::control {
namespace {

bool is_solid(const ModelPlate<float>& plate) { return plate.stiffness >= static_cast<float>(Scene::kSolid); }

/// Negative outside.
P way_out(const ModelPlate<float>& plate, const Vec3<P>& p, float radius) {
  const P x = p.x - P(plate.x), y = p.y - P(plate.y), cosine(plate.cosine), sine(plate.sine);
  const P along = cosine * x + sine * y, across = cosine * y - sine * x;
  const P first = P(plate.half_x + radius) - max(along, -along),
          second = P(plate.half_y + radius) - max(across, -across),
          up = P(plate.height - static_cast<float>(Scene::kReach) + radius) - p.z,
          down = P(radius - (plate.height - static_cast<float>(Scene::kSides))) + p.z;
  return min(min(first, second), min(up, down));
}

}  // namespace

bool has_sides(const System& system) {
  return std::any_of(system.model.plates.begin(), system.model.plates.end(), is_solid);
}

Array<P, kLegSpheres> depths_in_sides(const System& system, const Data<P>& d) {
  Array<P, kLegSpheres> depths;
  for (int k = 0; k < kLegSpheres; ++k) {
    const LegSphere& sphere = system.legs[k];
    const Vec3<P> p_B{P(sphere.p_B.x()), P(sphere.p_B.y()), P(sphere.p_B.z())};
    const Vec3<P> p = d.p_WB[sphere.body] + d.R_WB[sphere.body] * p_B;
    depths[k] = P(0.0);
    for (const ModelPlate<float>& plate : system.model.plates)
      if (is_solid(plate)) depths[k] = max(depths[k], way_out(plate, p, static_cast<float>(sphere.radius)));
  }
  return depths;
}

SideDepths side_depths(const System& system, const Data<double>& d) {
  SideDepths out;
  out.by_tangent.setZero();
  for (int k = 0; k < kLegSpheres; ++k) {
    const LegSphere& sphere = system.legs[k];
    const Vector3d p =
        to_eigen(d.p_WB[sphere.body]) + to_eigen(d.q_WB[sphere.body]).toRotationMatrix() * sphere.p_B;
    const WayOut way = system.scene.way_out(p, sphere.radius);
    out.depth[k] = way.depth;
    if (way.depth == 0.0) continue;
    out.by_tangent.row(k).head<3>() = -way.direction;
    for_each_rotation(d, sphere.body, [&](int body, const Vector3d& axis, int coordinate) {
      const Vector3d arm = p - to_eigen(d.p_WB[body]);
      out.by_tangent(k, coordinate) = -way.direction.dot(axis.cross(arm));
    });
  }
  return out;
}

}  // namespace mimicx::control
