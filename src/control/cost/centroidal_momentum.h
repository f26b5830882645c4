/// Centroidal momentum: the velocity of the centre of mass and the angular momentum about it, both per unit
/// of the body's mass, with their derivatives by the state.
///
/// Forces from outside are the only cause of its change: its derivative is the floor's force and moment. So a
/// motion whose momentum is smooth has smooth ground forces.                             docs/control.md §6
/// Source: D. E. Orin, A. Goswami, S.-H. Lee, "Centroidal dynamics of a humanoid robot" (2013), for the
/// matrix A(q) of h = A q̇; the derivatives by the pose are derived in docs/control.md §6.
#pragma once

#include <Eigen/Core>

#include "control/tangent.h"

namespace mimicx::control {

template <class T>
struct CentroidalMomentum {
  Vec3<T> linear;   ///< velocity of the centre of mass, m/s, world
  Vec3<T> angular;  ///< angular momentum about the centre of mass over the mass, m²/s, world
};

/// @param kinematics  of the state (`update_kinematics`)
template <class T>
CentroidalMomentum<T> centroidal_momentum(const Model<RealOf<T>>& model, const Data<T>& kinematics);

/// Derivatives of (linear, angular) by the 122 coordinates of tangent.h; the right half is the centroidal
/// momentum matrix over the mass.
using CentroidalJacobian = Eigen::Matrix<double, 6, kTangent>;
CentroidalJacobian centroidal_jacobian(const Model<double>& model, const Data<double>& kinematics);

}  // namespace mimicx::control
