/// The collision shapes of the simulator as a mesh: it shows exactly what touches where.
///
/// The capsules of all bodies, and the balls of feet and insteps. Each is one piece that follows its own
/// body. (Heels and tips of the toes touch the floor in points, which have no surface.)
#pragma once

#include <vector>

#include "skin/mesh.h"

namespace mimicx::skin {

/// Capsules in their bodies' frames; a ball is a capsule of length 0.
std::vector<Capsule> collision_capsules(const Character& character);

Mesh collision_shapes(const Character& character);

}  // namespace mimicx::skin
