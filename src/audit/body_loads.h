/// Newton–Euler for every body of a motion, by finite differences of its frames.
///
/// The load of a body is the force at its centre of mass and the moment about it that its motion requires
/// beside gravity. Accelerations are second differences of the frames; changes of angular momentum are
/// differences of its means over the intervals before and after a frame. Both equal the true ones averaged
/// with triangular weights from the frame before to the frame after.
#pragma once

#include "character/character.h"
#include "core/containers.h"
#include "core/units.h"

namespace mimicx::audit {

struct BodyLoad {
  Vector3d p_com;   ///< centre of mass, m
  Vector3d force;   ///< N
  Vector3d moment;  ///< about p_com, N·m
};

/// Loads at frame t, world axes. @param t  1 … frames − 2
PerBody<BodyLoad> body_loads(const Character& character, const PerFrame<BodyPoses>& poses, int t, double fps,
                             double gravity = kGravity);

/// Moment about `center` and force that the whole body needs.
Vector6d wrench_of(const PerBody<BodyLoad>& loads, const Vector3d& center);

/// Moment about each joint, N·m, world axes, that a body and its descendants need from their parent if no
/// external force acts on them; entry 0: about the pelvis joint, external.
PerBody<Vector3d> joint_moments(const PerBody<BodyLoad>& loads, const BodyPoses& poses);

/// An external force on a body at a point, world axes.
struct Push {
  int body;
  Vector3d p;      ///< m
  Vector3d force;  ///< N
};
/// Subtracts a push's contribution from the moments that the joints must supply.
void subtract_push(const Push& push, const BodyPoses& poses, PerBody<Vector3d>& moments);

/// The size of each joint's torque in parts of its bound; of a hinge the part about its axis. Entry 0 is 0.
/// @param torque  child's frame, N·m
PerBody<double> torque_shares(const Character& c, const PerBody<Vector3d>& torque);

}  // namespace mimicx::audit
