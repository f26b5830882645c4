#include "skin/shapes.h"

#include <numbers>

#include "core/elementary.h"

namespace mimicx::skin {
namespace {

constexpr int kAround = 20, kRings = 6;  ///< points of a circle; steps from the equator to a pole

/// Adds a closed capsule with vertices on the exact surface; of length 0 a ball.
void add_capsule(int body, const Vector3d& a, const Vector3d& b, double radius, Mesh& mesh) {
  const bool is_ball = (b - a).norm() < 1e-9;
  const Vector3d along = is_ball ? Vector3d(Vector3d::UnitY()) : Vector3d((b - a).normalized());
  const Vector3d side = along.unitOrthogonal(), other = along.cross(side);
  const int first = mesh.vertices.count();
  const auto add = [&](const Vector3d& centre, const Vector3d& normal) {
    mesh.vertices.push_back(centre + radius * normal);
    mesh.normals.push_back(normal);
    mesh.joints.push_back({{body, 0, 0, 0}});
    mesh.weights.push_back({{1.0, 0.0, 0.0, 0.0}});
  };
  add(a, -along);
  int rings = 0;
  const auto add_ring = [&](const Vector3d& centre, int step) {
    const double latitude = 0.5 * std::numbers::pi * step / kRings;
    for (int k = 0; k < kAround; ++k) {
      const double longitude = 2.0 * std::numbers::pi * k / kAround;
      const Vector3d out = cos(longitude) * side + sin(longitude) * other;
      add(centre, cos(latitude) * out + sin(latitude) * along);
    }
    ++rings;
  };
  for (int step = 1 - kRings; step <= 0; ++step) add_ring(a, step);
  for (int step = is_ball ? 1 : 0; step < kRings; ++step) add_ring(b, step);
  add(b, along);
  const auto at = [&](int ring, int k) { return first + 1 + ring * kAround + k % kAround; };
  const int last = mesh.vertices.count() - 1;
  for (int k = 0; k < kAround; ++k) {
    mesh.triangles.push_back({first, at(0, k + 1), at(0, k)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k)});
      mesh.triangles.push_back({at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
    mesh.triangles.push_back({at(rings - 1, k), at(rings - 1, k + 1), last});
  }
}

}  // namespace

std::vector<Capsule> collision_capsules(const Character& character) {
  std::vector<Capsule> capsules(character.capsule.begin(), character.capsule.end());
  for (const ContactPoint& point : character.contact_points) {
    const bool of_a_foot = point.body == kLeftAnkle || point.body == kRightAnkle;
    if (of_a_foot && point.radius > 0.0) capsules.push_back({point.body, point.p_B, point.p_B, point.radius});
  }
  return capsules;
}

Mesh collision_shapes(const Character& character) {
  const PerBody<Vector3d> joint = bind_joints(character);
  Mesh mesh;
  for (const Capsule& c : collision_capsules(character))
    add_capsule(c.body, joint[c.body] + c.a_B, joint[c.body] + c.b_B, c.radius, mesh);
  return mesh;
}

}  // namespace mimicx::skin
