/// The mesh of an arrow that shows a force.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

/// From the origin to (0, 1, 0), of length 1; it follows no body. Vertices on its edges are doubled, so that
/// the edges look sharp.
Mesh arrow();

}  // namespace mimicx::skin
