#include "skin/shapes.h"

#include <numbers>

#include "skin/mesh_checks.h"

namespace mimicx::skin {
namespace {

TEST(CollisionShapes, EveryShapeIsOneClosedPiece) {
  const Mesh mesh = collision_shapes(make_character());
  const Topology topology = topology_of(mesh);
  EXPECT_TRUE(topology.closed && topology.fans);
  EXPECT_EQ(topology.euler, std::vector<int>(kBodies + 6, 2));  // two balls and an instep per foot
  expect_sound(mesh);
}

TEST(CollisionShapes, VerticesLieOnTheCapsuleOfTheirBody) {
  const Character c = make_character({0.5, 2.0, -1.0});
  const PerBody<Vector3d> joint = bind_joints(c);
  const Mesh mesh = collision_shapes(c);
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    const int body = mesh.joints[v][0];
    const auto off = [&](const Vector3d& a, const Vector3d& b, double radius) {
      const Vector3d way = mesh.vertices[v] - joint[body] - a, ab = b - a;
      const double length2 = ab.squaredNorm();
      const double u = length2 > 0.0 ? std::clamp(way.dot(ab) / length2, 0.0, 1.0) : 0.0;
      return std::abs((way - u * ab).norm() - radius);
    };
    const Capsule& k = c.capsule[body];
    double nearest = off(k.a_B, k.b_B, k.radius);
    for (const ContactPoint& point : c.contact_points)
      if (point.body == body) nearest = std::min(nearest, off(point.p_B, point.p_B, point.radius));
    EXPECT_LT(nearest, 1e-12);
    EXPECT_EQ(mesh.weights[v][0], 1.0);
  }
}

TEST(CollisionShapes, VolumeMatchesTheCapsulesUpToFacets) {
  const Character c = make_character();
  double volume = 0.0;
  for (const Capsule& k : c.capsule)
    volume += std::numbers::pi * k.radius * k.radius * ((k.b_B - k.a_B).norm() + 4.0 / 3.0 * k.radius);
  for (const ContactPoint& point : c.contact_points)
    if (point.body == kLeftAnkle || point.body == kRightAnkle)
      volume += 4.0 / 3.0 * std::numbers::pi * std::pow(point.radius, 3);
  const Mesh mesh = collision_shapes(c);
  const double own = enclosed_volume(mesh.vertices, mesh.triangles);
  EXPECT_LT(own, volume);
  EXPECT_GT(own, 0.96 * volume);
}

}  // namespace
}  // namespace mimicx::skin
