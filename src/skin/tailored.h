/// One skin for many bodies: the mannequin of one character, moved onto another one's shape.
///
/// A mannequin of its own takes 0.2 s on a coarse lattice and has triangles of its own; this takes 8 ms.
/// Where many bodies are shown at once, they share triangles and weights, and a body differs by its vertices
/// alone. Every body of the character takes its vertices along as the box around its capsule becomes that of
/// the other character's; a vertex between two bodies goes between. What is left to the other's own surface
/// (skin/flesh.h) is taken by Newton's steps.
///
/// What it does not do: no new triangles. On a body that is much larger, they are larger.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

/// The mesh of `from` on the body of `to`: vertices and normals are new, all else stays.
Mesh tailored(Mesh mesh, const Character& from, const Character& to);

}  // namespace mimicx::skin
