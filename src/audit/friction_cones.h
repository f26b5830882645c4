/// Floor forces inside friction cones that come nearest to a wanted wrench.
#pragma once

#include "audit/body_loads.h"
#include "character/character.h"
#include "core/containers.h"

namespace mimicx::audit {

struct Floor {
  double friction = 1.0;  ///< μ
  int edges = 8;          ///< of the pyramid inscribed in the round cone
  double small_forces =
      1e-6;  ///< weight of the squared forces relative to the squared rest: makes them unique
};

/// Sets the forces of the pushes so that they come nearest to `wanted` = (moment about `center`, N·m; force,
/// N). 1 N·m counts as much as 1 N.
/// @param prices  weight of the squared forces of each push, times `small_forces`; empty: 1
/// @return the rest of `wanted`
Vector6d fit_cone_forces(const Floor& floor, const Vector3d& center, const Vector6d& wanted,
                         List<Push>& pushes, const List<double>& prices = {});

}  // namespace mimicx::audit
