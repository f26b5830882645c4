/// PD controller, torque bound and anatomical range of a joint.
#pragma once

#include "core/so3.h"

namespace mimicx {

/// PD controller, limits and armature of the joint that connects a body to its parent.
struct JointParameters {
  double kp = 0;            ///< N·m/rad
  double kd = 0;            ///< N·m·s/rad
  double armature = 0;      ///< kg·m²
  double torque_limit = 0;  ///< N·m: |τ| of a hinge, ‖τ‖ of a spherical joint
  /// Anatomical range: rotation from `centre` (a rotation vector; the component along the axis for a
  /// hinge) stays inside the ellipsoid of half axes `half_range` (rad) in the child's frame at rest.
  Vector3d centre = Vector3d::Zero();
  Vector3d half_range = Vector3d::Constant(3.0);
};

}  // namespace mimicx
