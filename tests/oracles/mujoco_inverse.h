/// Inverse dynamics and momentum by MuJoCo, in the conventions of physics/inverse_dynamics.h.
///
/// The same questions answered by another library's equations (`mj_inverse`, `mj_subtreeVel`): nothing of
/// src/physics takes part but the text of the exported model. Only compiled where MuJoCo is installed.
#pragma once

#include "oracles/mujoco_character.h"
#include "physics/inverse_dynamics.h"

namespace mimicx::test {

/// What mj_inverse says the joints and the root must supply for the motion under these wrenches. Contacts of
/// MuJoCo's own are switched off: what the floor does stands in the wrenches.
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
