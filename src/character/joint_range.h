/// Distance of a joint's rotation from its anatomical range.                        docs/physics.md §3
///
/// The range is the simulator's: beyond it, a spring of `limit_stiffness` times this distance pushes back
/// (physics/joint_torques.h).
#pragma once

#include "character/joint_parameters.h"

namespace mimicx {

struct RangeDistance {
  double excess = 0;  ///< distance to the surface, rad; below 0 inside
  Vector3d slope;     ///< its derivative by δ of the rotation q·exp(δ), child's frame; 0 at the centre
};

/// @param body  1 … kBodies − 1: the joint between the body and its parent
/// @param q     rotation relative to the parent; of a hinge about its axis
RangeDistance range_distance(const JointParameters& joint, int body, const Quaterniond& q);

}  // namespace mimicx
