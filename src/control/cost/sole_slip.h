/// Slip of the points of the soles, with its derivatives by the state.                     docs/control.md §6
///
///     r = max(ν, ν*) v_xy − (1 − ν) ν* v*_xy,   ν = 1 / (1 + (z₋/h)²),   z₋ = max(0, z)
///
/// z and v are a point's height over the ground under it and its velocity, h = kNearFloor. A point on the
/// floor counts with its whole velocity; a swinging point counts less the higher it is. The cost therefore
/// favours standing still or lifting the foot. ν* says whether the goal's point comes to rest now and stands
/// within the next two frames. A foot that is to land must come to rest as fast as the goal's, whose velocity
/// is v*, because friction stops it as soon as it lands. How fast it comes down does not count: that would
/// reward a foot that lands late. Nor does a foot count that the goal still swings: it would be braked too
/// early.
#pragma once

#include <Eigen/Core>

#include "control/system.h"
#include "control/tangent.h"

namespace mimicx::control {

inline constexpr double kNearFloor = 0.005;  ///< h, m
inline constexpr double kSwinging = 0.03;    ///< H, m per frame
inline constexpr int kFramesAhead = 2;

/// World positions of the points of the soles, m. @param kinematics  of a state (`update_kinematics`)
using SolePlaces = Array<Vec3<double>, kFootPoints>;
SolePlaces sole_places(const System& system, const Data<double>& kinematics);

/// What a point of the goal's soles is about to do.
struct Landing {
  double near = 0.0;        ///< ν*
  Eigen::Vector2d v{0, 0};  ///< ν* v*, m/s
};
using Landings = Array<Landing, kFootPoints>;
/// Those of all frames of a goal, from the places of its soles:
///
///     ν*_t = max_{t < s ≤ t + kFramesAhead} 1 / ((1 + (z₋_s/h)²) (1 + (|d_s|/h)²) (1 + (|d_t|/H)²))
///     v*_t = d_t fps
///
/// z_s is the height of the goal's point in frame s, and d_s the way that it moves over the ground until the
/// frame after.
List<Landings> landings(const System& system, const List<SolePlaces>& goal);

/// r of every sole point, m/s, world; z is zero.
/// @param goal        of the frame
/// @param kinematics  of the state (`update_kinematics`)
template <class T>
Array<Vec3<T>, kFootPoints> sole_slip(const System& system, const Landings& goal, const Data<T>& kinematics);

/// Derivatives of r (x and y, point after point) by the 122 coordinates of tangent.h.
using SoleSlipJacobian = Eigen::Matrix<double, 2 * kFootPoints, kTangent>;
SoleSlipJacobian sole_slip_jacobian(const System& system, const Landings& goal,
                                    const Data<double>& kinematics);

}  // namespace mimicx::control
