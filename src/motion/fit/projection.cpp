#include "motion/fit/projection.h"

#include <cmath>

namespace mimicx::motion::fit {
namespace {

Matrix3d turn_of(double tilt) { return Eigen::AngleAxisd(tilt, Vector3d::UnitX()).toRotationMatrix(); }

}  // namespace

Projection project_point(const FitProblem& problem, const FitState& state, int t, std::size_t k,
                         const Vector3d& p_W) {
  Projection out;
  const Eigen::Matrix4d& E = problem.camera(t);
  const Matrix3d turn = turn_of(state.g[kTilt]);
  const Vector3d p_C = turn * (E * p_W.homogeneous()).head<3>();
  out.valid = p_C.z() > kClosest && problem.box[t] > 0.0;
  if (!out.valid) return out;
  Matrix3d K = problem.intrinsics;
  K.topLeftCorner<2, 2>() *= std::exp(state.g[kLogFocal]);
  const Vector3d pixel = K * p_C;
  const Eigen::Vector2d uv = pixel.hnormalized();
  Eigen::Matrix<double, 2, 3> by_camera;  // of the pixel by p_C
  by_camera = (K.topRows<2>() - uv * K.row(2)) / pixel.z() / problem.box[t];
  out.by_point = by_camera * turn * E.topLeftCorner<3, 3>();
  out.by_tilt = by_camera * Vector3d::UnitX().cross(p_C);
  out.by_focal = K.topLeftCorner<2, 2>() * p_C.head<2>() / pixel.z() / problem.box[t];
  out.error = (uv - problem.uvc[t][k].head<2>()) / problem.box[t] +
              state.g.segment<2>(kFirstOffset + 2 * static_cast<int>(k));
  return out;
}

}  // namespace mimicx::motion::fit
