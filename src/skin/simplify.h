/// Reduces the triangles of a surface: contracts edges, the least important first, then evens out the
/// vertices.
///
/// The importance of an edge grows with its length and with the turn of the normal along it, so that flat
/// parts get large triangles and round parts small ones. The mesh stays a closed manifold: an edge is
/// contracted only if its ends have exactly two neighbours in common (the link condition: Dey, Edelsbrunner,
/// Guha, Nekhayev, "Topology preserving edge contraction", 1999) and no triangle turns over.
#pragma once

#include "skin/flesh.h"
#include "skin/isosurface.h"

namespace mimicx::skin {

/// @param triangles  of the result; more are left if no further edge may be contracted
Surface simplified(const Surface& surface, const Flesh& flesh, int triangles);

/// Moves vertices towards the middle of their neighbours along the surface, and back onto it.
void even_out(Surface& surface, const Flesh& flesh, int rounds);

}  // namespace mimicx::skin
