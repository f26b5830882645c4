/// Slip of the points of the soles, with its derivatives by the state.                     docs/control.md §6
///
///     r = ν v_xy,   ν = 1 / (1 + (z₋/h)²),   z₋ = max(0, z + Δ min(0, v_z))
///
/// z and v are a point's height over the ground under it and its velocity, h = kNearFloor, Δ = kAhead. A
/// point on the floor counts with its whole velocity; a swinging point counts less the higher it is. The cost
/// therefore favours standing still or lifting the foot. A falling foot counts at its height one frame ahead,
/// because friction stops it as soon as it lands.
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
