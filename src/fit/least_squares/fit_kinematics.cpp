#include "fit/least_squares/fit_kinematics.h"

#include "core/elementary.h"

namespace mimicx::fit {
namespace {

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d x;
  x << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return x;
}

/// The right Jacobian of SO(3): exp(c + δ) ≈ exp(c)·exp(Jr(c)·δ).  docs/method.md, "Keypoint fit", (5)
Matrix3d right_jacobian(const Vector3d& c) {
  const double angle = c.norm();
  const Matrix3d x = cross_matrix(c);
  if (angle < 1e-4) return Matrix3d::Identity() - 0.5 * x + x * x / 6.0;
  const double square = angle * angle;
  return Matrix3d::Identity() - (1.0 - cos(angle)) / square * x +
         (angle - sin(angle)) / (square * angle) * x * x;
}

}  // namespace

FrameKinematics kinematics(const FitProblem& problem, const FitState& state, const Character& character,
                           int t) {
  FrameKinematics k;
  const FrameVector& c = state.c[t];
  k.poses = forward_kinematics(character, problem.p_root[t] + c.head<3>(), rotations_of(problem, state, t));
  for (int b = 0; b < kBodies; ++b) {
    k.R[b] = k.poses.q_WB[b].toRotationMatrix();
    if (b > 0 && is_hinge(b)) {
      k.M[b].setZero();
      k.M[b].col(0) = k.R[b] * hinge_axis(b);
    } else {
      const int at = b == 0 ? kRootRotation : kFirstJoint + first_dof(b);
      k.M[b] = k.R[b] * right_jacobian(c.segment<3>(at));
    }
    if (b == 0) {
      k.by_beta[b].setZero();
    } else {
      const int parent = kParents[b];
      k.by_beta[b] = k.by_beta[parent] + k.R[parent] * problem.offset_by_beta[b];
    }
  }
  return k;
}

FootPositions foot_positions(const Character& character, const FrameKinematics& k) {
  FootPositions feet;
  for (std::size_t i = 0; i < kFootPoints; ++i) {
    const ContactPoint& point = character.contact_points[i];
    feet[i] = k.poses.p_WB[point.body] + k.R[point.body] * sole_point(point);
  }
  return feet;
}

PointJacobian point_jacobian(const FrameKinematics& k, int body, const Vector3d& p) {
  PointJacobian J = PointJacobian::Zero();
  J.leftCols<3>().setIdentity();
  for (int b = body; b >= 0; b = kParents[b]) {
    const Matrix3d lever = cross_matrix(k.poses.p_WB[b] - p);  // ω × (p − p_joint) = (p_joint − p) × ω
    if (b > 0 && is_hinge(b))
      J.col(kFirstJoint + first_dof(b)) = lever * k.M[b].col(0);
    else
      J.middleCols<3>(b == 0 ? kRootRotation : kFirstJoint + first_dof(b)) = lever * k.M[b];
  }
  return J;
}

}  // namespace mimicx::fit
