/// The shapes that the simulator collides with, as a mesh: what touches, exactly where.
///
/// The capsules of all bodies, and the balls that the feet and insteps have beside them, each in one piece
/// that follows its own body. (Heels and tips of the toes touch the floor in points, which have no surface.)
#pragma once

#include <vector>

#include "skin/mesh.h"

namespace mimicx::skin {

/// Capsules in their bodies' frames; a ball is one of no length.
std::vector<Capsule> collision_capsules(const Character& character);

Mesh collision_shapes(const Character& character);

}  // namespace mimicx::skin
