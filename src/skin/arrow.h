/// An arrow, to show a force.
#pragma once

#include "skin/mesh.h"

namespace mimicx::skin {

/// From the origin to (0, 1, 0), of length 1; it follows no body. Its edges are sharp: vertices stand there
/// twice.
Mesh arrow();

}  // namespace mimicx::skin
