/// What a picture shows: closed meshes with a colour at every vertex.
#pragma once

#include "render/image.h"
#include "skin/mesh.h"

namespace mimicx::render {

struct Solid {
  List<Vector3d> vertices;         ///< [V] world, m
  List<Vector3d> normals;          ///< [V] outward, unit length
  List<Colour> colours;            ///< [V] share of the light that is thrown back
  List<skin::Triangle> triangles;  ///< [F] counter-clockwise from outside
  bool is_sign = false;            ///< a sign, no thing: it is seen through things and throws no shadow
};

}  // namespace mimicx::render
