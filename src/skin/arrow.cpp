#include "skin/arrow.h"

#include <numbers>

namespace mimicx::skin {

Mesh arrow() {  // half an outline turned around the y axis
  constexpr int kAround = 16;
  constexpr double kShaft = 0.011, kHead = 0.03, kNeck = 0.86;
  struct Ring {
    double radius, height;
    Vector3d normal;  ///< in the plane x, y
  };
  const Vector3d slope = Vector3d(1.0 - kNeck, kHead, 0).normalized();
  const List<Ring> outline = {{0, 0, {0, -1, 0}},          {kShaft, 0, {0, -1, 0}},
                              {kShaft, 0, {1, 0, 0}},      {kShaft, kNeck, {1, 0, 0}},
                              {kShaft, kNeck, {0, -1, 0}}, {kHead, kNeck, {0, -1, 0}},
                              {kHead, kNeck, slope},       {0, 1, slope}};
  Mesh mesh;
  for (const Ring& ring : outline)
    for (int k = 0; k < kAround; ++k) {
      const double angle = -2.0 * std::numbers::pi * k / kAround;
      const Quaterniond turn = exp_map(angle * Vector3d::UnitY());
      mesh.vertices.push_back(turn * Vector3d(ring.radius, ring.height, 0));
      mesh.normals.push_back(turn * ring.normal);
    }
  for (int ring = 0; ring + 1 < outline.count(); ring += 2)  // edges are sharp: two rings each
    for (int k = 0; k < kAround; ++k) {
      const int a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      if (outline[ring].radius > 0.0) mesh.triangles.push_back({a, a + kAround, b});
      if (outline[ring + 1].radius > 0.0) mesh.triangles.push_back({b, a + kAround, b + kAround});
    }
  return mesh;
}

}  // namespace mimicx::skin
