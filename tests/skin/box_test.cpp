#include "skin/box.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mimicx::skin {
namespace {

TEST(Box, TrianglesFaceOutwardsAsTheirNormalsSay) {
  const Mesh mesh = box();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d p = mesh.vertices[a];
    const Vector3d turned = (mesh.vertices[b] - p).cross(mesh.vertices[c] - p).normalized();
    EXPECT_LT((turned - mesh.normals[a]).norm(), 1e-12);
    EXPECT_GT(turned.dot(p - Vector3d(0.0, 0.0, 0.5)), 0.0);
  }
}

TEST(Box, EndsInItsPlateAndOnTheFloor) {
  const Mesh mesh = box();
  const Plate plate{{1.0, -2.0}, 0.6, {0.3, 0.1}, 0.4};
  const List<Vector3d> vertices = box_under(plate, mesh);
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    EXPECT_EQ(vertices[v].z(), mesh.vertices[v].z() == 1.0 ? 0.4 : 0.0);
    const Vector3d own = rotation_z(-0.6) * (vertices[v] - Vector3d(1.0, -2.0, 0.0));
    EXPECT_NEAR(std::abs(own.x()), 0.3, 1e-12);
    EXPECT_NEAR(std::abs(own.y()), 0.1, 1e-12);
  }
}

}  // namespace
}  // namespace mimicx::skin
