/// Simple solids.
#pragma once

#include "render/solid.h"

namespace mimicx::render {

/// Flat faces: every triangle has vertices of its own. @param faces  counter-clockwise from outside
inline Solid faceted(const List<std::array<Vector3d, 3>>& faces, const Colour& colour) {
  Solid solid;
  for (const auto& [a, b, c] : faces) {
    const int first = solid.vertices.count();
    for (const Vector3d& p : {a, b, c}) {
      solid.vertices.push_back(p);
      solid.normals.push_back((b - a).cross(c - a).normalized());
      solid.colours.push_back(colour);
    }
    solid.triangles.push_back({first, first + 1, first + 2});
  }
  return solid;
}

inline Solid tetrahedron(const std::array<Vector3d, 4>& p, const Colour& colour) {
  const bool is_right_handed = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) > 0.0;
  const auto [a, b, c, d] = is_right_handed ? std::array{p[0], p[2], p[1], p[3]} : p;
  return faceted({{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}}, colour);
}

inline Solid box(const Vector3d& low, const Vector3d& high, const Colour& colour) {
  const auto corner = [&](int k) {
    return Vector3d((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                    (k & 4) != 0 ? high.z() : low.z());
  };
  List<std::array<Vector3d, 3>> faces;
  const auto add = [&](int a, int b, int c, int d) {
    faces.push_back({corner(a), corner(b), corner(c)});
    faces.push_back({corner(a), corner(c), corner(d)});
  };
  add(0, 2, 3, 1);
  add(4, 5, 7, 6);
  add(0, 1, 5, 4);
  add(2, 6, 7, 3);
  add(0, 4, 6, 2);
  add(1, 3, 7, 5);
  return faceted(faces, colour);
}

}  // namespace mimicx::render
