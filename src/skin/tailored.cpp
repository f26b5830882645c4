#include "skin/tailored.h"

#include "skin/flesh.h"

namespace mimicx::skin {
namespace {

/// The box around the capsule of every body, bind pose, m.
PerBody<Eigen::AlignedBox3d> boxes_of(const Character& character) {
  const PerBody<Vector3d> joint = bind_joints(character);
  PerBody<Eigen::AlignedBox3d> boxes;
  for (const Capsule& c : character.capsule)
    for (const Vector3d& end_B : {c.a_B, c.b_B})
      for (const double side : {-c.radius, c.radius})
        boxes[c.body].extend(joint[c.body] + end_B + Vector3d::Constant(side));
  return boxes;
}

}  // namespace

Mesh tailored(Mesh mesh, const Character& from, const Character& to) {
  const PerBody<Eigen::AlignedBox3d> before = boxes_of(from), after = boxes_of(to);
  const Flesh flesh(to);
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    Vector3d moved = Vector3d::Zero();
    for (int k = 0; k < kInfluences; ++k) {
      const int b = mesh.joints[v][k];
      const Vector3d share = (mesh.vertices[v] - before[b].center()).cwiseQuotient(before[b].sizes());
      moved += mesh.weights[v][k] * (after[b].center() + share.cwiseProduct(after[b].sizes()));
    }
    mesh.vertices[v] = flesh.on_surface(moved);
    mesh.normals[v] = flesh.normal(mesh.vertices[v]);
  }
  return mesh;
}

}  // namespace mimicx::skin
