/// Slip of the points of the soles, with its derivatives by the state.                     docs/control.md §6
///
///     r = ν v_xy,   ν = 1 / (1 + (z₋/h)²),   z₋ = max(0, z + Δ min(0, v_z))
///
/// z and v are a point's height over the ground under it and its velocity, h = kNearFloor, Δ = kAhead: a foot
/// that touches the floor slips by its velocity, and one that swings over it slips the less the higher it is.
/// So less slip is had by standing still or by lifting the foot. A foot that comes down counts by where it
/// will be a frame later: when it has touched the floor, friction has stopped it, and nothing is to be seen.
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
