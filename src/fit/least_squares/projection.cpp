#include "fit/least_squares/projection.h"

#include <algorithm>

#include "core/elementary.h"

namespace mimicx::fit {
namespace {

Matrix3d turn_of(double tilt) { return rotation_about(Vector3d::UnitX(), tilt).toRotationMatrix(); }

/// Velocity of a joint by central differences, m per frame.
Vector3d velocity(const PerFrame<FrameKinematics>& motion, int t, int body) {
  const int before = std::max(t - 1, 0), after = std::min(t + 1, motion.count() - 1);
  const Vector3d d = motion[after].poses.p_WB[body] - motion[before].poses.p_WB[body];
  return d / std::max(after - before, 1);
}

}  // namespace

Projection project_point(const FitProblem& problem, const FitState& state, int t, std::size_t k,
                         const Vector3d& p_W, const Vector3d& v_W) {
  Projection out;
  const Eigen::Matrix4d& E = motion::camera_at(problem.extrinsics, t);
  const Matrix3d turn = turn_of(state.g[kTilt]);
  const Vector3d p_C = turn * (E * (p_W + state.g[kLead] * v_W).homogeneous()).head<3>();
  out.valid = p_C.z() > kClosest && problem.box[t] > 0.0;
  if (!out.valid) return out;
  Matrix3d K = problem.intrinsics;
  K.topLeftCorner<2, 2>() *= exp(state.g[kLogFocal]);
  const Vector3d pixel = K * p_C;
  const Eigen::Vector2d uv = pixel.hnormalized();
  Eigen::Matrix<double, 2, 3> by_camera;  // of the pixel by p_C
  by_camera = (K.topRows<2>() - uv * K.row(2)) / pixel.z() / problem.box[t];
  out.by_point = by_camera * turn * E.topLeftCorner<3, 3>();
  out.by_camera.col(kTilt) = by_camera * Vector3d::UnitX().cross(p_C);
  out.by_camera.col(kLogFocal) = K.topLeftCorner<2, 2>() * p_C.head<2>() / pixel.z() / problem.box[t];
  out.by_camera.col(kLead) = out.by_point * v_W;
  out.error =
      (uv - problem.uvc[t][k].head<2>()) / problem.box[t] + state.g.segment<kFlatOffset>(offset_of(k));
  return out;
}

Vector3d point_of(const FitProblem& problem, const FitState& state, const FrameKinematics& k,
                  std::size_t point) {
  const FitPoint& p = problem.points[point];
  const Vector3d p_B = p.p_B + p.by_beta * state.g.segment<kBetas>(kFirstBeta) +
                       state.g.segment<3>(offset_of(point) + kFlatOffset);
  return k.poses.p_WB[p.body] + k.R[p.body] * p_B;
}

Projection keypoint_error(const FitProblem& problem, const FitState& state,
                          const PerFrame<FrameKinematics>& motion, int t, std::size_t k) {
  return project_point(problem, state, t, k, point_of(problem, state, motion[t], k),
                       velocity(motion, t, problem.points[k].body));
}

KeypointDerivatives keypoint_derivatives(const FitProblem& problem, const FitState& state,
                                         const PerFrame<FrameKinematics>& motion, int t, std::size_t k) {
  KeypointDerivatives out;
  out.seen = keypoint_error(problem, state, motion, t, k);
  if (!out.seen.valid) return out;
  const int body = problem.points[k].body;
  out.by_frame = out.seen.by_point * point_jacobian(motion[t], body, point_of(problem, state, motion[t], k));
  const ShapeJacobian by_beta = motion[t].by_beta[body] + motion[t].R[body] * problem.points[k].by_beta;
  out.by_clip << out.seen.by_camera, out.seen.by_point * by_beta;
  out.by_offset << Eigen::Matrix2d::Identity(), out.seen.by_point * motion[t].R[body];
  return out;
}

}  // namespace mimicx::fit
