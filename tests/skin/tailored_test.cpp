#include "skin/tailored.h"

#include "skin/flesh.h"
#include "skin/mannequin.h"
#include "skin/mesh_checks.h"

namespace mimicx::skin {
namespace {

constexpr int kTriangles = 3000;
constexpr double kCell = 0.026;

const Mesh& coarse_mesh() {
  static const Mesh mesh = mannequin(make_character(), kTriangles, kCell);
  return mesh;
}

TEST(Tailored, MannequinOnACoarseLatticeIsOneClosedBody) {
  const Topology topology = topology_of(coarse_mesh());
  EXPECT_TRUE(topology.closed && topology.fans);
  EXPECT_EQ(topology.euler, std::vector<int>{2});
}

TEST(Tailored, IsTheIdentityOnItsOwnBody) {
  const Mesh& mesh = coarse_mesh();
  const Mesh same = tailored(mesh, make_character(), make_character());
  for (int v = 0; v < mesh.vertices.count(); ++v)
    EXPECT_LT((same.vertices[v] - mesh.vertices[v]).norm(), 0.002) << v;
}

TEST(Tailored, LiesOnTheOtherBodysSurfaceWithOutwardTriangles) {
  const Character standard = make_character();
  for (const std::array<double, kBetas>& betas :
       {std::array<double, kBetas>{0, 4}, {0.4, 1.7, 2.0, -2.8, 2.0, 1.9, -0.8, -1.6, -1.9, 0.2}}) {
    const Character other = make_character(betas);
    const Mesh mesh = tailored(coarse_mesh(), standard, other);
    EXPECT_EQ(mesh.triangles, coarse_mesh().triangles);
    EXPECT_EQ(mesh.weights, coarse_mesh().weights);
    const Flesh flesh(other);
    for (const Vector3d& p : mesh.vertices) EXPECT_LT(std::abs(flesh.distance(p)), 0.005);
    int inward = 0;
    for (const Triangle& t : mesh.triangles) {
      const Vector3d a = mesh.vertices[t[1]] - mesh.vertices[t[0]],
                     b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
      inward += a.cross(b).dot(mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]) <= 0.0 ? 1 : 0;
    }
    EXPECT_LT(inward, kTriangles / 100);
    const Mesh own = mannequin(other, kTriangles, kCell);  // another way to the same body
    EXPECT_NEAR(enclosed_volume(mesh.vertices, mesh.triangles) / enclosed_volume(own.vertices, own.triangles),
                1.0, 0.03);
  }
}

}  // namespace
}  // namespace mimicx::skin
