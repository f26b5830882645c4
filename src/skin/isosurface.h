/// The surface of a solid given by a signed distance, as a closed mesh of triangles.
///
/// Marching tetrahedra on a body-centred cubic lattice: corners and centres of cubes, four tetrahedra around
/// every face of a cube, all congruent. For any signs at their corners the surface is closed and a manifold:
/// every edge has two triangles, and the triangles around a vertex form one fan. (Lattice: Labelle and
/// Shewchuk, "Isosurface Stuffing", SIGGRAPH 2007; here the surface alone, without warping.)
#pragma once

#include <functional>

#include "skin/mesh.h"

namespace mimicx::skin {

struct Surface {
  List<Vector3d> vertices;   ///< m
  List<Triangle> triangles;  ///< counter-clockwise from outside
};

/// @param distance  negative inside; positive on the rim of the box; Lipschitz constant at most 1
/// @param cell      edge of the cubes, m
Surface isosurface(const std::function<double(const Vector3d&)>& distance, const Eigen::AlignedBox3d& box,
                   double cell);

}  // namespace mimicx::skin
