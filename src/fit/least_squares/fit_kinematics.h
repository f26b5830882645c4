/// Poses of the keypoint fit with their derivatives.
///
/// A correction c moves a rotation q·exp(c) in its own frame by Jr(c)·δc (Jr: the right Jacobian of SO(3)),
/// hence in the world by M·δc with M = R_WB·Jr(c); a point p on the body or its descendants moves by
/// (M·δc) × (p − p_joint). A hinge has one column, its axis in the world.
#pragma once

#include "fit/least_squares/fit_problem.h"

namespace mimicx::fit {

using PointJacobian = Eigen::Matrix<double, 3, kFrameUnknowns>;
using FootPositions = Array<Vector3d, kFootPoints>;  ///< of the points of the soles, world, m

/// Poses of a frame, and the matrices that their derivatives need.
struct FrameKinematics {
  BodyPoses poses;
  PerBody<Matrix3d> R;             ///< R_WB
  PerBody<Matrix3d> M;             ///< joint's correction → rotation in the world; a hinge: column 0
  PerBody<ShapeJacobian> by_beta;  ///< of the joint positions
};
FrameKinematics kinematics(const FitProblem& problem, const FitState& state, const Character& character,
                           int t);

/// Positions of the points of the soles in a frame, m.
FootPositions foot_positions(const Character& character, const FrameKinematics& k);

/// Derivative of a point p (world, m) fixed to a body.
PointJacobian point_jacobian(const FrameKinematics& k, int body, const Vector3d& p);

}  // namespace mimicx::fit
