/// The floor's forces on a simulated body as arrows: one per foot and one for all else, each at its centre of
/// pressure.
///
/// Wrenches (n_i; f_i) about the bodies' joint centres p_i, world axes, sum to f = Σ f_i and, about the
/// world's origin, n = Σ n_i + p_i × f_i. The point of the floor z = 0 about which n has no horizontal part
/// is the centre of pressure (P. Sardain, G. Bessonnet, IEEE Trans. Syst. Man Cybern. A 34 (2004), §II):
///     x = −n_y / f_z,  y = n_x / f_z.
#pragma once

#include <vector>

#include "character/character.h"

namespace mimicx::pipeline::report {

struct GroundForce {
  Vector3d point = Vector3d::Zero();  ///< centre of pressure on the floor, m; zero without a force
  Vector3d force = Vector3d::Zero();  ///< N
};
inline constexpr int kGroundArrows = 3;
/// Left foot, right foot (ankle and ball each), all other bodies together.
using GroundForces = Array<GroundForce, kGroundArrows>;

/// @param wrenches  (moment; force) about the joint centres of `poses`, world axes, N·m, N
GroundForces ground_forces(const PerBody<Vector6d>& wrenches, const BodyPoses& poses);

}  // namespace mimicx::pipeline::report
