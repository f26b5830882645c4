/// The best that a floor can do: pushes inside friction cones that come nearest to what a body needs.
#pragma once

#include "audit/body_loads.h"
#include "character/character.h"
#include "core/containers.h"

namespace mimicx::audit {

struct Floor {
  double friction = 1.0;       ///< μ
  int edges = 8;               ///< of the pyramid inside of the round cone
  double small_forces = 1e-6;  ///< weight of the squared forces beside the squared rest: makes them unique
};

/// Gives the pushes the forces that come nearest to `wanted` = (moment about `center`, N·m; force, N), a N·m
/// counting as much as a N.
/// @return what is left of it
Vector6d share_out(const Floor& floor, const Vector3d& center, const Vector6d& wanted, List<Push>& pushes);

}  // namespace mimicx::audit
