/// Inverse dynamics: the forces that a motion needs, by the recursive Newton–Euler algorithm.
///
/// Source: R. Featherstone, "Rigid Body Dynamics Algorithms" (2008, "RBDA"), table 5.1, with its symbols:
/// spatial vectors (angular; linear) in *body* coordinates, the Plücker transforms of table 2.2. Always in
/// double, and apart from the simulator on purpose: it shares `Character` with it and nothing else, so that a
/// motion can be audited by other equations than those that made it (docs/physics.md §9).
///
/// Given position, velocity and acceleration of a character and the wrenches that floor and other bodies
/// exert on it, the joints must supply `joint`, and something outside of the body would have to supply
/// `root`, which is zero for a motion that the wrenches explain. What it does not do: contact, limits,
/// control.
#pragma once

#include <array>

#include "character/character.h"

namespace mimicx::physics {

/// Position, velocity and acceleration; conventions of physics/data.h.
struct MotionState {
  Vector3d p_root, v_root, a_root;  ///< pelvis joint in world; a is the derivative of v
  PerBody<Quaterniond> q;           ///< unit; [0] pelvis → world, joints child → parent
  PerBody<Vector3d> omega;          ///< [0] pelvis; joints relative to the parent; own frame, rad/s
  PerBody<Vector3d> omega_d;        ///< derivatives of these numbers, rad/s²
};

/// External wrench on every body: moment about its joint centre, N·m; force, N; world axes.
using BodyWrenches = PerBody<Vector6d>;

struct RequiredForces {
  Vector6d root;            ///< moment about the pelvis joint, N·m; force, N; world axes
  PerBody<Vector3d> joint;  ///< child's frame, N·m; of a hinge the part about its axis; [0] zero
};

/// Armature included; gravity downwards, m/s².
RequiredForces inverse_dynamics(const Character& character, double gravity, const MotionState& state,
                                const BodyWrenches& external);

}  // namespace mimicx::physics
