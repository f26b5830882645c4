#include "skin/mesh.h"

namespace mimicx::skin {

PerBody<Vector3d> bind_joints(const Character& character) {
  PerBody<Quaterniond> rest;
  rest.fill(Quaterniond::Identity());
  return forward_kinematics(character, Vector3d::Zero(), rest).p_WB;
}

List<Vector3d> posed_vertices(const Mesh& mesh, const Character& character, const BodyPoses& poses) {
  const PerBody<Vector3d> bind = bind_joints(character);
  PerBody<Matrix3d> R_WB;
  for (int b = 0; b < kBodies; ++b) R_WB[b] = poses.q_WB[b].toRotationMatrix();
  List<Vector3d> posed;
  posed.reserve(mesh.vertices.size());
  for (int v = 0; v < mesh.vertices.count(); ++v) {
    Vector3d p = Vector3d::Zero();
    for (int k = 0; k < kInfluences; ++k) {
      const int b = mesh.joints[v][k];
      p += mesh.weights[v][k] * (poses.p_WB[b] + R_WB[b] * (mesh.vertices[v] - bind[b]));
    }
    posed.push_back(p);
  }
  return posed;
}

List<Vector3d> vertex_normals(const List<Vector3d>& vertices, const List<Triangle>& triangles) {
  List<Vector3d> normals(vertices.count(), Vector3d::Zero());
  for (const Triangle& t : triangles) {
    const Vector3d area = (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]);
    for (const int v : t) normals[v] += area;
  }
  for (Vector3d& n : normals) n = n.norm() > 0.0 ? Vector3d(n.normalized()) : Vector3d(Vector3d::UnitZ());
  return normals;
}

}  // namespace mimicx::skin
