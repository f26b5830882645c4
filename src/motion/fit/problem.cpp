#include "motion/fit/problem.h"

#include <algorithm>
#include <cmath>

#include "motion/estimator_error.h"
#include "motion/reference.h"
#include "motion/surface.h"

namespace mimicx {
namespace {

constexpr double kClosest = 0.2;           ///< m in front of the camera, else nothing is seen
constexpr double kMedianToSigma = 1.4826;  ///< of a normal distribution
constexpr double kThirdDifference = 20.0;  ///< variance of a third difference of white noise of variance 1

/// The right Jacobian of SO(3): exp(c + δ) ≈ exp(c)·exp(Jr(c)·δ).
Matrix3d right_jacobian(const Vector3d& c) {
  const double angle = c.norm();
  Matrix3d x;
  x << 0, -c.z(), c.y(), c.z(), 0, -c.x(), -c.y(), c.x(), 0;
  if (angle < 1e-4) return Matrix3d::Identity() - 0.5 * x + x * x / 6.0;
  const double square = angle * angle;
  return Matrix3d::Identity() - (1.0 - std::cos(angle)) / square * x +
         (angle - std::sin(angle)) / (square * angle) * x * x;
}

/// The other side's body of a limb (below shoulder or hip), itself for every other body.
int mirrored_limb(int body) {
  switch (body) {
    case kLeftHip:
    case kLeftKnee:
    case kLeftAnkle:
    case kLeftFoot:
    case kLeftShoulder:
    case kLeftElbow:
    case kLeftWrist:
      return body + 1;
    case kRightHip:
    case kRightKnee:
    case kRightAnkle:
    case kRightFoot:
    case kRightShoulder:
    case kRightElbow:
    case kRightWrist:
      return body - 1;
    default:
      return body;
  }
}

void add_points(const Keypoints& keypoints, FitProblem& problem) {
  for (std::size_t k = 0; k < keypoints.names.size(); ++k)
    if (const int body = body_of_name(keypoints.names[k]); body >= 0) problem.points.push_back({body, k, 0});
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const int other = mirrored_limb(problem.points[i].body);
    const auto found = std::find_if(problem.points.begin(), problem.points.end(),
                                    [&](const FitPoint& p) { return p.body == other; });
    problem.points[i].mirror =
        found == problem.points.end() ? i : static_cast<std::size_t>(found - problem.points.begin());
  }
  for (const auto& frame : keypoints.uvc) {
    problem.uvc.emplace_back();
    for (const FitPoint& point : problem.points) {
      const Vector3d& seen = frame[point.column];
      problem.uvc.back().push_back(seen.allFinite() ? seen : Vector3d::Zero());
    }
  }
  problem.intrinsics = keypoints.intrinsics;
  problem.extrinsics = keypoints.extrinsics;
}

/// Larger side of the box around the 22 projected joints of the input, px; 0 where the camera does not see
/// it.
double box_of(const FitProblem& problem, std::size_t t, const BodyPoses& poses) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30), high = -low;
  for (const Vector3d& p : poses.p_WB) {
    const Vector3d p_C = (problem.camera(t) * p.homogeneous()).head<3>();
    if (p_C.z() < kClosest) return 0.0;
    const Eigen::Vector2d uv = (problem.intrinsics * p_C).hnormalized();
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  return (high - low).maxCoeff();
}

/// Standard deviation of the white part of a series: third differences leave little of a human motion.
double jitter_of(std::vector<double> third_differences) {
  if (third_differences.empty()) return 0.0;
  const auto middle = third_differences.begin() + static_cast<std::ptrdiff_t>(third_differences.size() / 2);
  std::nth_element(third_differences.begin(), middle, third_differences.end());
  return kMedianToSigma * *middle / std::sqrt(kThirdDifference);
}

void measure_jitter(const std::vector<PerBody<Quaterniond>>& q, FitProblem& problem) {
  std::vector<double> rotations, positions;
  for (std::size_t t = 0; t + 3 < q.size(); ++t) {
    for (std::size_t b = 1; b < kBodies; ++b) {
      std::array<Vector3d, 3> step;
      for (std::size_t i = 0; i < 3; ++i) step[i] = log_map(q[t + i][b].conjugate() * q[t + i + 1][b]);
      for (double x :
           ((step[0] - 2.0 * step[1] + step[2]) / relative_joint_error(static_cast<int>(b))).eval())
        rotations.push_back(std::abs(x));
    }
    const auto& p = problem.p_root;
    for (double x : (p[t + 3] - 3.0 * p[t + 2] + 3.0 * p[t + 1] - p[t]).eval())
      positions.push_back(std::abs(x));
  }
  problem.rotation_jitter = jitter_of(std::move(rotations));
  problem.position_jitter = jitter_of(std::move(positions));
}

void add_shape_derivatives(FitProblem& problem) {
  const Character standard = make_character();
  problem.foot_by_beta.assign(kFootPoints, ShapeJacobian::Zero());
  for (int i = 0; i < kBetas; ++i) {
    std::array<double, kBetas> unit{};
    unit[static_cast<std::size_t>(i)] = 1.0;
    const Character character = make_character(unit);
    for (std::size_t b = 0; b < kBodies; ++b)
      problem.offset_by_beta[b].col(i) = character.joint_offset[b] - standard.joint_offset[b];
    for (std::size_t f = 0; f < kFootPoints; ++f)
      problem.foot_by_beta[f].col(i) =
          sole_point(character.contact_points[f]) - sole_point(standard.contact_points[f]);
  }
}

Matrix3d turn_of(double tilt) { return Eigen::AngleAxisd(tilt, Vector3d::UnitX()).toRotationMatrix(); }

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d x;
  x << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return x;
}

}  // namespace

FitProblem make_problem(const Clip& clip, const FitOptions& options) {
  FitProblem problem;
  problem.options = options;
  problem.fps = clip.fps;
  problem.betas = clip.usable_betas();
  if (clip.keypoints && !clip.rest_joints)  // nothing else tells of the shape, or it is known
    problem.beta_sigma = clip.body_model == "mimicx" ? options.beta_sigma : options.foreign_beta_sigma;
  problem.rest_joints = clip.rest_joints;
  const Character character = character_of(clip);
  const auto input = joint_rotations(clip);
  problem.q = to_hinges(character, input);
  for (const Vector3d& trans : clip.trans) problem.p_root.push_back(trans + rest_pelvis(clip));
  add_shape_derivatives(problem);
  measure_jitter(input, problem);
  if (!clip.keypoints) return problem;
  add_points(*clip.keypoints, problem);
  for (std::size_t t = 0; t < problem.q.size(); ++t)
    problem.box.push_back(box_of(problem, t, forward_kinematics(character, problem.p_root[t], problem.q[t])));
  return problem;
}

FitState initial_state(const FitProblem& problem) {
  return {std::vector<FrameVector>(problem.q.size(), FrameVector::Zero()), VectorXd::Zero(problem.globals())};
}

Character character_of(const FitProblem& problem, const FitState& state) {
  if (problem.rest_joints) return make_character_of_joints(*problem.rest_joints);
  std::array<double, kBetas> betas = problem.betas;
  for (std::size_t i = 0; i < kBetas; ++i)
    betas[i] = std::clamp(betas[i] + state.g[kFirstBeta + static_cast<int>(i)], -kMaxBeta, kMaxBeta);
  return make_character(betas);
}

PerBody<Quaterniond> rotations_of(const FitProblem& problem, const FitState& state, std::size_t t) {
  PerBody<Quaterniond> q = problem.q[t];
  const FrameVector& c = state.c[t];
  q[0] = (q[0] * exp_map(c.segment<3>(kRootRotation))).normalized();
  for (int b = 1; b < kBodies; ++b) {
    const int at = kFirstJoint + first_dof(b);
    const Vector3d turn = is_hinge(b) ? Vector3d(c[at] * hinge_axis(b)) : Vector3d(c.segment<3>(at));
    Quaterniond& joint = q[static_cast<std::size_t>(b)];
    joint = (joint * exp_map(turn)).normalized();
  }
  return q;
}

FrameKinematics kinematics(const FitProblem& problem, const FitState& state, const Character& character,
                           std::size_t t) {
  FrameKinematics k;
  const FrameVector& c = state.c[t];
  k.poses = forward_kinematics(character, problem.p_root[t] + c.head<3>(), rotations_of(problem, state, t));
  for (int b = 0; b < kBodies; ++b) {
    const auto i = static_cast<std::size_t>(b);
    k.R[i] = k.poses.q_WB[i].toRotationMatrix();
    if (b > 0 && is_hinge(b)) {
      k.M[i].setZero();
      k.M[i].col(0) = k.R[i] * hinge_axis(b);
    } else {
      const int at = b == 0 ? kRootRotation : kFirstJoint + first_dof(b);
      k.M[i] = k.R[i] * right_jacobian(c.segment<3>(at));
    }
    if (b == 0) {
      k.by_beta[i].setZero();
    } else {
      const auto parent = static_cast<std::size_t>(kParents[i]);
      k.by_beta[i] = k.by_beta[parent] + k.R[parent] * problem.offset_by_beta[i];
    }
  }
  return k;
}

PointJacobian point_jacobian(const FrameKinematics& k, int body, const Vector3d& p) {
  PointJacobian J = PointJacobian::Zero();
  J.leftCols<3>().setIdentity();
  for (int b = body; b >= 0; b = kParents[static_cast<std::size_t>(b)]) {
    const auto i = static_cast<std::size_t>(b);
    const Matrix3d lever = cross_matrix(k.poses.p_WB[i] - p);  // ω × (p − p_joint) = (p_joint − p) × ω
    if (b > 0 && is_hinge(b))
      J.col(kFirstJoint + first_dof(b)) = lever * k.M[i].col(0);
    else
      J.middleCols<3>(b == 0 ? kRootRotation : kFirstJoint + first_dof(b)) = lever * k.M[i];
  }
  return J;
}

Projection project_point(const FitProblem& problem, const FitState& state, std::size_t t, std::size_t k,
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

}  // namespace mimicx
