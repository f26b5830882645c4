/// Newton and Euler for every body of a motion, by differences of its frames.
///
/// The load of a body is what has to push it so that it moves as it does: force at its centre of mass and
/// moment about it, gravity taken off. Accelerations are second differences of the frames, changes of angular
/// momentum are those of its means over the intervals before and after a frame. Both are exactly the mean of
/// the true ones, weighted by a triangle from the frame before to the frame after.
#pragma once

#include "character/character.h"
#include "core/containers.h"

namespace mimicx::audit {

struct BodyLoad {
  Vector3d p_com;   ///< centre of mass, m
  Vector3d force;   ///< N
  Vector3d moment;  ///< about p_com, N·m
};

/// Loads at frame t, world axes. @param t  1 … frames − 2
PerBody<BodyLoad> body_loads(const Character& character, const PerFrame<BodyPoses>& poses, int t, double fps);

/// Moment about `center` and force that the body as a whole needs.
Vector6d wrench_of(const PerBody<BodyLoad>& loads, const Vector3d& center);

/// Moment about each joint, N·m, world axes, that a body and those beyond it need from their parent where
/// nothing but the joint pushes them; entry 0: about the pelvis joint, from outside.
PerBody<Vector3d> joint_moments(const PerBody<BodyLoad>& loads, const BodyPoses& poses);

/// What pushes a body from outside, at a point of the world.
struct Push {
  int body;
  Vector3d p;      ///< m
  Vector3d force;  ///< N
};
/// Takes what a push does off the moments that the joints have to give.
void take_off(const Push& push, const BodyPoses& poses, PerBody<Vector3d>& moments);

/// How near torques come to what the joints can give: the size of each joint's torque in parts of its bound;
/// of a hinge the part about its axis. Entry 0 is 0.
/// @param torque  child's frame, N·m
PerBody<double> torque_shares(const Character& c, const PerBody<Vector3d>& torque);

}  // namespace mimicx::audit
