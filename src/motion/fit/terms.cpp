#include "motion/fit/terms.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "motion/estimator_error.h"
#include "motion/fit/projection.h"

namespace mimicx::motion::fit {
namespace {

constexpr double kFps = 30.0;          ///< frame rate at which the settings' rates are meant
constexpr double kWristFactor = 3.0;   ///< wrists move fast and blur
constexpr double kFloorKernel = 0.03;  ///< m: a "standing" foot so far off the floor has lost half its weight
constexpr double kAccelerationKernel = 3.0;  ///< in its σ: landings and kicks may be sharp
constexpr double kSlipKernel = 5.0;          ///< in its σ: a foot that begins to move
constexpr double kFixed = 1e-6;              ///< σ of an unknown that is not estimated

using JointsJacobian = Eigen::Matrix<double, 3 * kBodies, kFrameUnknowns>;

double square(double x) { return x * x; }
/// Weight of a residual under a Cauchy kernel: 1 at 0, one half at `width`.
double cauchy(double squared_residual, double width) {
  return 1.0 / (1.0 + squared_residual / square(width));
}
double information(double sigma) { return 1.0 / square(std::max(sigma, kFixed)); }

/// Adds the terms of one linearisation to a system, term by term.
struct Assembler {
  const FitProblem& problem;
  const FitState& state;
  const PerFrame<FrameKinematics>& motion;
  const PerFrame<FootPositions>& feet;
  const Contacts& contacts;
  BorderedBand& system;

  double time_scale() const { return kFps / problem.fps; }
  void keypoints(int t);
  void globals();
  void priors(int t);
  void smoothness(int t);
  void acceleration();
  void standing(int t);
  void slipping(int t);
};

/// Projected joints against detections. J: by the unknowns of the frame; G: by those of the clip; r:
/// residuals, all over σ and under the kernel. σ grows with 1/confidence².
void Assembler::keypoints(int t) {
  const auto rows = static_cast<Eigen::Index>(2 * problem.points.size());
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, kFrameUnknowns),
                  G = Eigen::MatrixXd::Zero(rows, problem.globals());
  VectorXd r = VectorXd::Zero(rows);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const double confidence = problem.uvc[t][k].z();
    if (confidence <= 0.0) continue;
    const int body = problem.points[k].body;
    const Vector3d& p = motion[t].poses.p_WB[body];
    const Projection seen = project_point(problem, state, t, k, p);
    if (!seen.valid) continue;
    const bool wrist = body == kLeftWrist || body == kRightWrist;
    const double sigma = problem.config.keypoint_sigma * (wrist ? kWristFactor : 1.0);
    const double scale = square(confidence) / sigma *
                         std::sqrt(cauchy(seen.error.squaredNorm(), problem.config.keypoint_kernel));
    const auto row = static_cast<Eigen::Index>(2 * k);
    J.middleRows<2>(row) = scale * seen.by_point * point_jacobian(motion[t], body, p);
    G.block<2, 1>(row, kTilt) = scale * seen.by_tilt;
    G.block<2, 1>(row, kLogFocal) = scale * seen.by_focal;
    G.block<2, kBetas>(row, kFirstBeta) = scale * seen.by_point * motion[t].by_beta[body];
    G.block<2, 2>(row, kFirstOffset + row) = scale * Eigen::Matrix2d::Identity();
    r.segment<2>(row) = scale * seen.error;
  }
  system.diagonal[t].noalias() += J.transpose() * J;
  system.border[t].noalias() += J.transpose() * G;
  system.corner.noalias() += G.transpose() * G;
  system.rhs[t].noalias() -= J.transpose() * r;
  system.rhs_border.noalias() -= G.transpose() * r;
}

void Assembler::globals() {
  const FitConfig& o = problem.config;
  VectorXd weight(problem.globals());
  weight.setConstant(information(o.keypoint_bias_sigma));
  weight[kTilt] = o.told_weight * information(kDegree * o.tilt_sigma);
  weight[kLogFocal] = o.told_weight * information(o.focal_sigma);
  weight.segment<kBetas>(kFirstBeta).setConstant(o.told_weight * information(problem.beta_sigma));
  system.corner.diagonal() += weight;
  system.rhs_border -= weight.cwiseProduct(state.g);
}

/// One number for every unknown of a frame, from a figure for positions, one for the root and one for joints.
FrameVector per_unknown(double position, double rotation, double joint) {
  FrameVector v;
  v.head<3>().setConstant(position);
  v.segment<3>(kRootRotation).setConstant(rotation);
  for (int b = 1; b < kBodies; ++b)
    v.segment(kFirstJoint + first_dof(b), is_hinge(b) ? 1 : 3).setConstant(joint * relative_joint_error(b));
  return v;
}

void Assembler::priors(int t) {
  const FitConfig& o = problem.config;
  const FrameVector sigma =
      per_unknown(o.root_position_sigma, kDegree * o.root_rotation_sigma, kDegree * o.joint_sigma);
  const FrameVector weight = sigma.array().square().inverse() / (o.prior_frames / time_scale());
  system.diagonal[t].diagonal() += weight;
  system.rhs[t] -= weight.cwiseProduct(state.c[t]);
}

/// First and second differences of the corrections; what the input itself jitters is allowed on top.
void Assembler::smoothness(int t) {
  const FitConfig& o = problem.config;
  const double s = time_scale();
  const FrameVector jitter =
      per_unknown(problem.position_jitter, problem.rotation_jitter, problem.rotation_jitter);
  if (t + 1 < state.c.count()) {
    const FrameVector rate =
        per_unknown(s * o.root_rate, s * kDegree * o.joint_rate, s * kDegree * o.joint_rate);
    const FrameVector w = (rate.array().square() + 2.0 * jitter.array().square()).inverse();
    const FrameVector d = w.cwiseProduct(state.c[t + 1] - state.c[t]);
    system.diagonal[t].diagonal() += w;
    system.diagonal[t + 1].diagonal() += w;
    system.next[t].diagonal() -= w;
    system.rhs[t] += d;
    system.rhs[t + 1] -= d;
  }
  if (t + 2 < state.c.count()) {
    const FrameVector bend =
        per_unknown(s * s * o.root_bend, s * s * kDegree * o.joint_bend, s * s * kDegree * o.joint_bend);
    const FrameVector w = (bend.array().square() + 6.0 * jitter.array().square()).inverse();
    const FrameVector d = w.cwiseProduct(state.c[t] - 2.0 * state.c[t + 1] + state.c[t + 2]);
    system.diagonal[t].diagonal() += w;
    system.diagonal[t + 1].diagonal() += 4.0 * w;
    system.diagonal[t + 2].diagonal() += w;
    system.next[t].diagonal() -= 2.0 * w;
    system.next[t + 1].diagonal() -= 2.0 * w;
    system.second[t].diagonal() += w;
    system.rhs[t] -= d;
    system.rhs[t + 1] += 2.0 * d;
    system.rhs[t + 2] -= d;
  }
}

/// Second differences of all joint positions. Neighbouring residuals share the frames' Jacobians J: block (s,
/// t) is Jₛᵀ diag(Σ aₛ aₜ w) Jₜ, with a = 1, -2, 1. The shape's influence on accelerations is left out.
void Assembler::acceleration() {
  const int frames = problem.frames();
  const double sigma = square(time_scale()) * problem.config.acceleration_sigma;
  using Joints = Eigen::Matrix<double, 3 * kBodies, 1>;
  PerFrame<Joints> diagonal(motion.size(), Joints::Zero()), next(diagonal), second(diagonal), pull(diagonal);
  for (int t = 1; t + 1 < frames; ++t)
    for (int b = 0; b < kBodies; ++b) {
      const Vector3d a =
          motion[t - 1].poses.p_WB[b] - 2.0 * motion[t].poses.p_WB[b] + motion[t + 1].poses.p_WB[b];
      const double w = information(sigma) * cauchy(a.squaredNorm(), kAccelerationKernel * sigma);
      const auto add = [&](Joints& v, double x) { v.segment<3>(3 * b).array() += w * x; };
      add(diagonal[t - 1], 1.0), add(diagonal[t], 4.0), add(diagonal[t + 1], 1.0);
      add(next[t - 1], -2.0), add(next[t], -2.0), add(second[t - 1], 1.0);
      pull[t - 1].segment<3>(3 * b) -= w * a;
      pull[t].segment<3>(3 * b) += 2.0 * w * a;
      pull[t + 1].segment<3>(3 * b) -= w * a;
    }
  PerFrame<JointsJacobian> J(motion.size());
  for (int t = 0; t < frames; ++t)
    for (int b = 0; b < kBodies; ++b)
      J[t].middleRows<3>(3 * b) = point_jacobian(motion[t], b, motion[t].poses.p_WB[b]);
  for (int t = 0; t < frames; ++t) {
    system.diagonal[t].noalias() += J[t].transpose() * (diagonal[t].asDiagonal() * J[t]);
    if (t + 1 < frames) system.next[t].noalias() += J[t + 1].transpose() * (next[t].asDiagonal() * J[t]);
    if (t + 2 < frames) system.second[t].noalias() += J[t + 2].transpose() * (second[t].asDiagonal() * J[t]);
    system.rhs[t].noalias() += J[t].transpose() * pull[t];
  }
}

/// Heights of the foot points: on the floor where they stand, not below it anywhere.
void Assembler::standing(int t) {
  for (int i = 0; i < kFootPoints; ++i) {
    const double z = feet[t][i].z();
    double w = 0.0;
    if (contacts[t][i]) w += information(problem.config.floor_sigma) * cauchy(z * z, kFloorKernel);
    if (z < 0.0) w += information(problem.config.penetration_sigma);
    if (w == 0.0) continue;
    const auto& [body, by_beta] = problem.foot_points[i];
    const Eigen::RowVectorXd J = point_jacobian(motion[t], body, feet[t][i]).row(2);
    const Eigen::Matrix<double, 1, kBetas> G = (motion[t].by_beta[body] + motion[t].R[body] * by_beta).row(2);
    system.diagonal[t].noalias() += w * J.transpose() * J;
    system.border[t].middleCols<kBetas>(kFirstBeta).noalias() += w * J.transpose() * G;
    system.corner.block<kBetas, kBetas>(kFirstBeta, kFirstBeta).noalias() += w * G.transpose() * G;
    system.rhs[t].noalias() -= w * z * J.transpose();
    system.rhs_border.segment<kBetas>(kFirstBeta).noalias() -= w * z * G.transpose();
  }
}

/// A point that stands in this frame and the next does not move. The shape's influence is left out.
void Assembler::slipping(int t) {
  const double sigma = time_scale() * problem.config.slip_sigma;
  for (int i = 0; i < kFootPoints; ++i) {
    if (!contacts[t][i] || !contacts[t + 1][i]) continue;
    const Vector3d d = feet[t + 1][i] - feet[t][i];
    const double w = information(sigma) * cauchy(d.squaredNorm(), kSlipKernel * sigma);
    const int body = problem.foot_points[i].body;
    const PointJacobian J0 = point_jacobian(motion[t], body, feet[t][i]),
                        J1 = point_jacobian(motion[t + 1], body, feet[t + 1][i]);
    system.diagonal[t].noalias() += w * J0.transpose() * J0;
    system.diagonal[t + 1].noalias() += w * J1.transpose() * J1;
    system.next[t].noalias() -= w * J1.transpose() * J0;
    system.rhs[t].noalias() += w * J0.transpose() * d;
    system.rhs[t + 1].noalias() -= w * J1.transpose() * d;
  }
}

}  // namespace

BorderedBand linearise(const FitProblem& problem, const FitState& state,
                       const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                       const Contacts& contacts) {
  BorderedBand system(problem.frames(), kFrameUnknowns, problem.globals());
  Assembler add{problem, state, motion, feet, contacts, system};
  add.globals();
  for (int t = 0; t < problem.frames(); ++t) {
    add.keypoints(t);
    add.priors(t);
    add.smoothness(t);
    add.standing(t);
    if (t + 1 < problem.frames()) add.slipping(t);
  }
  add.acceleration();
  return system;
}

}  // namespace mimicx::motion::fit
