/// The floor's forces on a simulated body as arrows: one per foot and one for all else, each at its centre of
/// pressure (output/floor_load.h).
#pragma once

#include <vector>

#include "character/character.h"

namespace mimicx::report {

struct GroundForce {
  Vector3d point = Vector3d::Zero();  ///< centre of pressure on the floor, m; zero without a force
  Vector3d force = Vector3d::Zero();  ///< N
};
inline constexpr int kGroundArrows = 3;
/// Left foot, right foot (ankle and ball each), all other bodies together.
using GroundForces = Array<GroundForce, kGroundArrows>;

/// @param wrenches  (moment; force) about the joint centres of `poses`, world axes, N·m, N
GroundForces ground_forces(const PerBody<Vector6d>& wrenches, const BodyPoses& poses);

}  // namespace mimicx::report
