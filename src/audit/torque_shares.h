/// How near torques come to what the joints can give.
#pragma once

#include "character/character.h"

namespace mimicx::audit {

/// Size of every joint's torque, 1 = its bound; of a hinge the part about its axis. Entry 0 is 0.
/// @param torque  child's frame, N·m
PerBody<double> torque_shares(const Character& c, const PerBody<Vector3d>& torque);

}  // namespace mimicx::audit
