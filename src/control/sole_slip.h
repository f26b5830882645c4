/// Horizontal velocity of the points of the soles, with its derivatives by the state.     docs/control.md §6
///
/// A standing foot that moves over the floor slips.
#pragma once

#include <Eigen/Core>

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

/// Velocity of every sole point, m/s, world. @param kinematics  of the state (`update_kinematics`)
template <class T>
Array<Vec3<T>, kFootPoints> sole_velocities(const System& system, const Data<T>& kinematics);

/// Derivatives of the horizontal velocities (x and y, point after point) by the 122 coordinates of tangent.h.
using SoleSlipJacobian = Eigen::Matrix<double, 2 * kFootPoints, kTangent>;
SoleSlipJacobian sole_slip_jacobian(const System& system, const Data<double>& kinematics);

}  // namespace mimicx::control
