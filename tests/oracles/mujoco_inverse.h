/// Inverse dynamics and momentum by MuJoCo, in the conventions of physics/inverse_dynamics.h.
///
/// Uses another library's equations (`mj_inverse`, `mj_subtreeVel`); the exported model is the only part of
/// src/physics that it needs. Only compiled where MuJoCo is installed.
#pragma once

#include "oracles/mujoco_character.h"
#include "physics/inverse_dynamics.h"

namespace mimicx::test {

/// The forces of joints and root that mj_inverse requires for the motion under these wrenches. MuJoCo's
/// contacts are switched off: the wrenches contain the floor's forces.
physics::RequiredForces mujoco_inverse_dynamics(MujocoCharacter& mujoco, const physics::MotionState& state,
                                                const physics::BodyWrenches& wrenches);

/// Of the whole: centre of mass, m, and momentum (angular about it; linear) in the world.
struct MujocoMomentum {
  Vector3d center;
  Vector6d about_center;
};
/// Of the state's position and velocity.
MujocoMomentum mujoco_momentum(MujocoCharacter& mujoco, const physics::MotionState& state);

}  // namespace mimicx::test
