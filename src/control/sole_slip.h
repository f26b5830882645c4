/// Slip of the points of the soles, with its derivatives by the state.                     docs/control.md §6
///
///     r = ν(z) v_xy,   ν(z) = 1 / (1 + (z₊/h)²)
///
/// z and v are a point's height over the floor and its velocity, z₊ = max(z, 0), h = kNearFloor: a foot that
/// touches the floor slips by its velocity, and one that swings over it slips the less the higher it is. So
/// less slip is had by standing still or by lifting the foot.
#pragma once

#include <Eigen/Core>

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

inline constexpr double kNearFloor = 0.005;   ///< h, m
inline constexpr double kAhead = 1.0 / 30.0;  ///< Δ, s

/// r of every sole point, m/s, world; z is zero. @param kinematics  of the state (`update_kinematics`)
template <class T>
Array<Vec3<T>, kFootPoints> sole_slip(const System& system, const Data<T>& kinematics);

/// Derivatives of r (x and y, point after point) by the 122 coordinates of tangent.h.
using SoleSlipJacobian = Eigen::Matrix<double, 2 * kFootPoints, kTangent>;
SoleSlipJacobian sole_slip_jacobian(const System& system, const Data<double>& kinematics);

}  // namespace mimicx::control
