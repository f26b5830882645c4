#include "skin/box.h"

#include <utility>

namespace mimicx::skin {

Mesh box() {
  Mesh mesh;
  const Vector3d middle(0.0, 0.0, 0.5), half(1.0, 1.0, 0.5);
  const auto add = [&](const Vector3d& normal, const Vector3d& side) {
    const Vector3d other = normal.cross(side);
    const int first = mesh.vertices.count();
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      mesh.vertices.push_back(middle + half.cwiseProduct(normal + a * side + b * other));
      mesh.normals.push_back(normal);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  add(Vector3d::UnitZ(), Vector3d::UnitX());
  for (const double sign : {1.0, -1.0}) {
    add(sign * Vector3d::UnitX(), Vector3d::UnitZ());
    add(sign * Vector3d::UnitY(), Vector3d::UnitZ());
  }
  return mesh;
}

List<Vector3d> box_under(const Plate& plate, const Mesh& mesh) {
  const Vector3d size(plate.half_extents.x(), plate.half_extents.y(), plate.height);
  const Vector3d centre(plate.centre.x(), plate.centre.y(), 0.0);
  List<Vector3d> vertices;
  for (const Vector3d& p : mesh.vertices)
    vertices.push_back(centre + rotation_z(plate.yaw) * size.cwiseProduct(p));
  return vertices;
}

}  // namespace mimicx::skin
