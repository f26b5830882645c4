/// The surface of a solid that is known by a signed distance, as a closed mesh of triangles.
///
/// Marching tetrahedra on a body-centred cubic lattice: corners and centres of cubes, four tetrahedra around
/// every face of a cube, all alike. Whatever the signs at their corners, the surface that they cut is closed
/// and a manifold: every edge has two triangles, and those around a vertex make one fan. (Lattice:
/// Labelle and Shewchuk, "Isosurface Stuffing", SIGGRAPH 2007; here its surface alone, without its warping.)
#pragma once

#include <functional>

#include "skin/mesh.h"

namespace mimicx::skin {

struct Surface {
  List<Vector3d> vertices;   ///< m
  List<Triangle> triangles;  ///< counter-clockwise from outside
};

/// @param distance  negative inside; positive on the rim of the box; changes by at most its argument's way
/// @param cell      edge of the cubes, m
Surface isosurface(const std::function<double(const Vector3d&)>& distance, const Eigen::AlignedBox3d& box,
                   double cell);

}  // namespace mimicx::skin
