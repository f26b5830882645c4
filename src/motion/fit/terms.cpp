#include "motion/fit/terms.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/units.h"
#include "motion/fit/levels.h"
#include "motion/fit/projection.h"

namespace mimicx::motion::fit {
namespace {

constexpr double kFloorKernel = 0.03;  ///< m: a "standing" foot so far off the floor has lost half its weight
constexpr double kAccelerationKernel = 3.0;  ///< in its σ: landings and kicks may be sharp
constexpr double kSlipKernel = 5.0;          ///< in its σ: a foot that begins to move
constexpr double kFixed = 1e-6;              ///< σ of an unknown that is not estimated

/// Of the coordinates of N points by a frame's unknowns.
template <int N>
using PointsJacobian = Eigen::Matrix<double, 3 * N, kFrameUnknowns>;

/// Weights of differences of N points over frames. Residuals that share a frame share its Jacobian J: block
/// (s, t) of the system is Jₛᵀ diag(Σ aₛ aₜ w) Jₜ, with the coefficients a of the differences, and the right
/// side of frame t is Jₜᵀ pull.
template <int N>
struct DifferenceWeights {
  using Coordinates = Eigen::Matrix<double, 3 * N, 1>;
  bool has_second;  ///< second differences: they reach over three frames
  PerFrame<Coordinates> diagonal, next, second, pull;

  DifferenceWeights(int frames, bool second_differences)
      : has_second(second_differences),
        diagonal(frames, Coordinates::Zero()),
        next(diagonal),
        second(second_differences ? diagonal : PerFrame<Coordinates>()),
        pull(diagonal) {}
};

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
  PerFrame<std::vector<double>> weights;  ///< of the detections

  /// Rows of a frame's detections, by the unknowns of the frame, the clip's, and the point's own offsets;
  /// errors.
  struct Rows {
    Eigen::MatrixXd J, G, O;
    VectorXd z;
  };
  Rows before, now;

  double time_scale() const { return kReferenceFps / problem.fps; }
  void look(int t);
  void add_border(int t, const Eigen::MatrixXd& J, const Eigen::MatrixXd& G, const Eigen::MatrixXd& O,
                  const VectorXd& r);
  void keypoints(int t);
  void globals();
  void priors(int t);
  void smoothness(int t);
  template <int N>
  void add_differences(const PerFrame<PointsJacobian<N>>& J, const DifferenceWeights<N>& w);
  void acceleration();
  void standing(int t);
  void slipping();
};

void Assembler::look(int t) {
  std::swap(before, now);
  const auto rows = static_cast<Eigen::Index>(2 * problem.points.size());
  now.J.setZero(rows, kFrameUnknowns);
  now.G.setZero(rows, kFirstOffset);
  now.O.setZero(rows, kOffsets);
  now.z.setZero(rows);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const double scale = weights[t][k];
    if (scale <= 0.0) continue;
    const SeenPoint point = see_closely(problem, state, motion, t, k);
    const auto row = static_cast<Eigen::Index>(2 * k);
    now.J.middleRows<2>(row) = scale * point.by_frame;
    now.G.middleRows<2>(row) = scale * point.by_clip;
    now.O.middleRows<2>(row) = scale * point.by_offset;
    now.z.segment<2>(row) = scale * point.seen.error;
  }
}

/// Projected joints against detections: what is new in the error of a frame after that of the frame before.
void Assembler::keypoints(int t) {
  look(t);
  const auto rows = now.z.size();
  VectorXd here = VectorXd::Ones(rows), kept = VectorXd::Zero(rows), own(rows);
  const double correlation = correlation_of(problem);
  const double grown = 1.0 / std::sqrt(1.0 - square(correlation));
  const auto follows = [&](int after, std::size_t k) {
    return after > 0 && after < problem.frames() && weights[after][k] > 0.0 && weights[after - 1][k] > 0.0;
  };
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    if (follows(t, k))
      here.segment<2>(row).setConstant(grown), kept.segment<2>(row).setConstant(correlation * grown);
    const double later = follows(t + 1, k) ? square(correlation * grown) : 0.0;
    own.segment<2>(row) = here.segment<2>(row).array().square() + later;
  }
  system.diagonal[t].noalias() += now.J.transpose() * (own.asDiagonal() * now.J);
  Eigen::MatrixXd G = here.asDiagonal() * now.G, O = here.asDiagonal() * now.O;
  VectorXd r = here.cwiseProduct(now.z);
  if (t > 0) {
    G -= kept.asDiagonal() * before.G;
    O -= kept.asDiagonal() * before.O;
    r -= kept.cwiseProduct(before.z);
    system.next[t - 1].noalias() -= now.J.transpose() * (here.cwiseProduct(kept).asDiagonal() * before.J);
    add_border(t - 1, -(kept.asDiagonal() * before.J).eval(), G, O, r);
  }
  add_border(t, here.asDiagonal() * now.J, G, O, r);
  system.corner.topLeftCorner<kFirstOffset, kFirstOffset>().noalias() += G.transpose() * G;
  system.rhs_border.head<kFirstOffset>().noalias() -= G.transpose() * r;
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    const int at = offset_of(k);
    const Eigen::Matrix<double, kOffsets, 2> offsets = O.middleRows<2>(row).transpose();
    const Eigen::Matrix<double, kOffsets, kFirstOffset> shared = offsets * G.middleRows<2>(row);
    system.corner.block<kOffsets, kFirstOffset>(at, 0) += shared;
    system.corner.block<kFirstOffset, kOffsets>(0, at) += shared.transpose();
    system.corner.block<kOffsets, kOffsets>(at, at) += offsets * offsets.transpose();
    system.rhs_border.segment<kOffsets>(at) -= offsets * r.segment<2>(row);
  }
}

/// What the rows J of a frame share with the clip's unknowns, and its right side.
void Assembler::add_border(int t, const Eigen::MatrixXd& J, const Eigen::MatrixXd& G,
                           const Eigen::MatrixXd& O, const VectorXd& r) {
  system.border[t].leftCols<kFirstOffset>().noalias() += J.transpose() * G;
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    system.border[t].middleCols<kOffsets>(offset_of(k)).noalias() +=
        J.middleRows<2>(row).transpose() * O.middleRows<2>(row);
  }
  system.rhs[t].noalias() -= J.transpose() * r;
}

void Assembler::globals() {
  const FitConfig& o = problem.config;
  VectorXd weight(problem.globals());
  weight[kTilt] = o.told_weight * information(kDegree * o.tilt_sigma);
  weight[kLogFocal] = o.told_weight * information(o.focal_sigma);
  weight[kLead] = information(o.lead_sigma / time_scale());
  for (int i = 0; i < kBetas; ++i)
    weight[kFirstBeta + i] = o.told_weight * information(problem.beta_sigma[i]);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    weight.segment<kFlatOffset>(offset_of(k)).setConstant(information(o.flat_offset_sigma));
    weight.segment<3>(offset_of(k) + kFlatOffset).setConstant(information(o.limb_offset_sigma));
  }
  system.corner.diagonal() += weight;
  system.rhs_border -= weight.cwiseProduct(state.g);
}

void Assembler::priors(int t) {
  const FrameVector weight = correction_levels(problem).size.array().square().inverse();
  system.diagonal[t].diagonal() += weight;
  system.rhs[t] -= weight.cwiseProduct(state.c[t]);
}

/// First and second differences of the corrections; what the input itself jitters is allowed on top.
void Assembler::smoothness(int t) {
  const CorrectionLevels level = correction_levels(problem);
  if (t + 1 < state.c.count()) {
    const FrameVector w = level.rate.array().square().inverse();
    const FrameVector d = w.cwiseProduct(state.c[t + 1] - state.c[t]);
    system.diagonal[t].diagonal() += w;
    system.diagonal[t + 1].diagonal() += w;
    system.next[t].diagonal() -= w;
    system.rhs[t] += d;
    system.rhs[t + 1] -= d;
  }
  if (t + 2 < state.c.count()) {
    const FrameVector w = level.bend.array().square().inverse();
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

/// Adds differences of points over frames: [frames] derivatives of the points' coordinates, and their
/// weights.
template <int N>
void Assembler::add_differences(const PerFrame<PointsJacobian<N>>& J, const DifferenceWeights<N>& w) {
  const int frames = problem.frames();
  constexpr int kFrames = 16;  // a chunk; every frame writes its own blocks
  parallel_for((frames + kFrames - 1) / kFrames, problem.config.threads, [&](int chunk) {
    for (int t = chunk * kFrames; t < std::min((chunk + 1) * kFrames, frames); ++t) {
      system.diagonal[t].noalias() += J[t].transpose() * (w.diagonal[t].asDiagonal() * J[t]);
      if (t + 1 < frames) system.next[t].noalias() += J[t + 1].transpose() * (w.next[t].asDiagonal() * J[t]);
      if (w.has_second && t + 2 < frames)
        system.second[t].noalias() += J[t + 2].transpose() * (w.second[t].asDiagonal() * J[t]);
      system.rhs[t].noalias() += J[t].transpose() * w.pull[t];
    }
  });
}

/// Second differences of all joint positions. The shape's influence on accelerations is left out.
void Assembler::acceleration() {
  const int frames = problem.frames();
  const double sigma = square(time_scale()) * problem.config.acceleration_sigma;
  DifferenceWeights<kBodies> weights(frames, true);
  for (int t = 1; t + 1 < frames; ++t)
    for (int b = 0; b < kBodies; ++b) {
      const Vector3d a =
          motion[t - 1].poses.p_WB[b] - 2.0 * motion[t].poses.p_WB[b] + motion[t + 1].poses.p_WB[b];
      const double w = information(sigma) * cauchy(a.squaredNorm(), kAccelerationKernel * sigma);
      const auto add = [&](auto& v, double x) { v.template segment<3>(3 * b).array() += w * x; };
      add(weights.diagonal[t - 1], 1.0), add(weights.diagonal[t], 4.0), add(weights.diagonal[t + 1], 1.0);
      add(weights.next[t - 1], -2.0), add(weights.next[t], -2.0), add(weights.second[t - 1], 1.0);
      weights.pull[t - 1].segment<3>(3 * b) -= w * a;
      weights.pull[t].segment<3>(3 * b) += 2.0 * w * a;
      weights.pull[t + 1].segment<3>(3 * b) -= w * a;
    }
  PerFrame<PointsJacobian<kBodies>> J(motion.size());
  for (int t = 0; t < frames; ++t)
    for (int b = 0; b < kBodies; ++b)
      J[t].middleRows<3>(3 * b) = point_jacobian(motion[t], b, motion[t].poses.p_WB[b]);
  add_differences<kBodies>(J, weights);
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
void Assembler::slipping() {
  const int frames = problem.frames();
  const double sigma = time_scale() * problem.config.slip_sigma;
  DifferenceWeights<kFootPoints> weights(frames, false);
  PerFrame<PointsJacobian<kFootPoints>> J(motion.size(), PointsJacobian<kFootPoints>::Zero());
  const auto stands_on = [&](int t, int i) { return contacts[t][i] && contacts[t + 1][i]; };
  for (int t = 0; t < frames; ++t)
    for (int i = 0; i < kFootPoints; ++i) {
      const bool stays = t + 1 < frames && stands_on(t, i);
      if (stays || (t > 0 && stands_on(t - 1, i)))
        J[t].middleRows<3>(3 * i) = point_jacobian(motion[t], problem.foot_points[i].body, feet[t][i]);
      if (!stays) continue;
      const Vector3d d = feet[t + 1][i] - feet[t][i];
      const double w = information(sigma) * cauchy(d.squaredNorm(), kSlipKernel * sigma);
      weights.diagonal[t].segment<3>(3 * i).array() += w;
      weights.diagonal[t + 1].segment<3>(3 * i).array() += w;
      weights.next[t].segment<3>(3 * i).array() -= w;
      weights.pull[t].segment<3>(3 * i) += w * d;
      weights.pull[t + 1].segment<3>(3 * i) -= w * d;
    }
  add_differences<kFootPoints>(J, weights);
}

}  // namespace

BorderedBand linearise(const FitProblem& problem, const FitState& state,
                       const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                       const Contacts& contacts) {
  BorderedBand system(problem.frames(), kFrameUnknowns, problem.globals());
  Assembler add{problem, state, motion, feet, contacts, system, detection_weights(problem, state, motion),
                {},      {}};
  add.globals();
  for (int t = 0; t < problem.frames(); ++t) {
    add.keypoints(t);
    add.priors(t);
    add.smoothness(t);
    add.standing(t);
  }
  add.slipping();
  if (problem.calms) add.acceleration();
  return system;
}

}  // namespace mimicx::motion::fit
