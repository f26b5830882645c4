/// The body as a mannequin: one smooth skin around the character, made of the character's own shapes.
///
/// There is no licensed mesh in it, and none is needed: flesh.h gives every body tapered shapes that follow
/// from its capsules and joints, isosurface.h finds their common surface, simplify.h thins it out. A body of
/// other betas gets another mannequin. It is made in about a second, the same bytes every time.
///
/// A vertex follows the bodies whose shapes are nearest to it: the weight of a body falls off as
/// exp(−(d / 12 mm)²) with the distance d to its shapes, so that the skin bends over some centimetres to both
/// sides of a joint, more on thick limbs than on thin ones. Limbs do not pull at each other: of two legs the
/// nearer one alone counts.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

inline constexpr int kMannequinTriangles = 12000;

/// Edge of the lattice on which it is found, m: finer than a thumb is wide.
inline constexpr double kMannequinCell = 0.016;

/// @param cell  a coarser lattice will do for fewer triangles, and takes less time
Mesh mannequin(const Character& character, int triangles = kMannequinTriangles, double cell = kMannequinCell);

}  // namespace mimicx::skin
