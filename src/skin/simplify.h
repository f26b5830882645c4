/// Fewer triangles: edges are drawn together, the least important first, and what is left is evened out.
///
/// An edge matters by its length and by how much the surface turns along it, so that flat parts get large
/// triangles and round ones small ones. The mesh stays closed and a manifold: only edges whose ends have
/// exactly two neighbours in common go (the link condition: Dey, Edelsbrunner, Guha, Nekhayev, "Topology
/// preserving edge contraction", 1999), and none that turn a triangle over.
#pragma once

#include "skin/flesh.h"
#include "skin/isosurface.h"

namespace mimicx::skin {

/// @param triangles  as many are left, or more where no further edge may go
Surface simplified(const Surface& surface, const Flesh& flesh, int triangles);

/// Moves vertices towards the middle of their neighbours along the surface, and back onto it.
void even_out(Surface& surface, const Flesh& flesh, int rounds);

}  // namespace mimicx::skin
