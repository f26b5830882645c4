/// The mesh of a box, such as one whose top face is a plate of a scene.
#pragma once

#include "character/scene.h"
#include "skin/mesh.h"

namespace mimicx::skin {

/// From (−1, −1, 0) to (1, 1, 1); it follows no body. Vertices are its faces' own, so that the edges look
/// sharp. It has no lower face, which stands on the floor.
Mesh box();

/// The vertices of the box under a plate, world, m. @param mesh  box()
List<Vector3d> box_under(const Plate& plate, const Mesh& mesh);

}  // namespace mimicx::skin
