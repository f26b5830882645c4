/// A solid in a picture: a closed mesh with a colour at every vertex.
#pragma once

#include "render/image.h"
#include "skin/mesh.h"

namespace mimicx::render {

struct Solid {
  List<Vector3d> vertices;         ///< [V] world, m
  List<Vector3d> normals;          ///< [V] outward, unit length
  List<Colour> colours;            ///< [V] albedo
  List<skin::Triangle> triangles;  ///< [F] counter-clockwise from outside
  bool is_sign = false;            ///< a marker: visible through solids, throws no shadow
};

}  // namespace mimicx::render
