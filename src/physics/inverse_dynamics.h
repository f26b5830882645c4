/// Inverse dynamics by the recursive Newton–Euler algorithm: the forces that a motion requires.
///
/// Source: R. Featherstone, "Rigid Body Dynamics Algorithms" (2008, "RBDA"), table 5.1, with its symbols:
/// spatial vectors (angular; linear) in *body* coordinates, the Plücker transforms of table 2.2. Always in
/// double, and independent of the simulator: it shares `Character` with it and nothing else, so that a motion
/// is audited by other equations than those that produced it (docs/physics.md §9).
///
/// Input: position, velocity and acceleration of a character, and the wrenches of floor and other bodies on
/// it. Result: the joint torques `joint`, and the external wrench `root` on the pelvis that the motion
/// requires beside them, zero if the given wrenches explain the motion. It has no contact, limits or control.
#pragma once

#include "character/character.h"

namespace mimicx::physics {

/// Position, velocity and acceleration; conventions of physics/data.h.
struct MotionState {
  Vector3d p_root, v_root, a_root;  ///< pelvis joint in world; a is the derivative of v
  PerBody<Quaterniond> q;           ///< unit; [0] pelvis → world, joints child → parent
  PerBody<Vector3d> omega;          ///< [0] pelvis; joints relative to the parent; own frame, rad/s
  PerBody<Vector3d> omega_d;        ///< time derivatives of the components of omega, rad/s²
};

/// External wrench on every body: moment about its joint centre, N·m; force, N; world axes.
using BodyWrenches = PerBody<Vector6d>;

struct RequiredForces {
  Vector6d root;            ///< moment about the pelvis joint, N·m; force, N; world axes
  PerBody<Vector3d> joint;  ///< child's frame, N·m; of a hinge the part about its axis; [0] zero
};

/// Armature included. @param gravity  downwards, m/s²
RequiredForces inverse_dynamics(const Character& character, double gravity, const MotionState& state,
                                const BodyWrenches& external);

}  // namespace mimicx::physics
