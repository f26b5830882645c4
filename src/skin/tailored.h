/// One skin for many bodies: the mannequin of one character, moved onto another one's shape.
///
/// Making a new mannequin takes 0.2 s on a coarse lattice and gives other triangles; this takes 8 ms and
/// keeps triangles and weights, so that many bodies that are shown at once differ by their vertices alone.
/// Each body moves its vertices by the affine map between the boxes around its capsule in the two characters;
/// a vertex of several bodies moves by their weighted mean. Newton's method then moves it onto the other
/// character's surface (skin/flesh.h).
///
/// It makes no new triangles: on a much larger body they are larger.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

/// The mesh of `from` on the body of `to`: new vertices and normals, the same triangles, joints and weights.
Mesh tailored(Mesh mesh, const Character& from, const Character& to);

}  // namespace mimicx::skin
