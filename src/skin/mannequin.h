/// The body as a mannequin: one smooth skin around the character, made of the character's own shapes.
///
/// It needs no licensed mesh: flesh.h gives every body tapered shapes that follow from its capsules and
/// joints, isosurface.h finds their common surface, simplify.h reduces its triangles. Every β has its own
/// mannequin. Making one takes about a second and gives the same bytes every time.
///
/// A vertex follows the bodies whose shapes are nearest to it: the weight of a body falls off as
/// exp(−(d / 12 mm)²) with the distance d to its shapes, so that the skin bends over some centimetres on both
/// sides of a joint, more on thick limbs than on thin ones. Of the two legs only the nearer one has weight.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

inline constexpr int kMannequinTriangles = 12000;

/// Edge of the lattice of the isosurface, m: less than the width of a thumb.
inline constexpr double kMannequinCell = 0.016;

/// @param cell  edge of the lattice, m; for fewer triangles a coarser one suffices, which takes less time
Mesh mannequin(const Character& character, int triangles = kMannequinTriangles, double cell = kMannequinCell);

}  // namespace mimicx::skin
