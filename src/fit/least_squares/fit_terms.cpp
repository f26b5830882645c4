#include "fit/least_squares/fit_terms.h"

#include <algorithm>
#include <utility>

#include "character/joint_range.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/units.h"
#include "fit/least_squares/detection_rows.h"
#include "fit/least_squares/error_levels.h"
#include "fit/least_squares/projection.h"

namespace mimicx::fit {
namespace {

constexpr double kFloorKernel = 0.03;        ///< m; at this height the weight of a "standing" foot is halved
constexpr double kAccelerationKernel = 3.0;  ///< in its σ; landings and kicks are sharp
constexpr double kSlipKernel = 5.0;          ///< in its σ; for feet that begin to move
constexpr double kFixed = 1e-6;              ///< σ of an unknown that is not estimated

/// Jacobian of the coordinates of N points by a frame's unknowns.
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

/// Weight of a residual under a Cauchy kernel: 1 at 0, one half at `width`.
double cauchy(double squared_residual, double width) {
  return 1.0 / (1.0 + squared_residual / square(width));
}
double information(double sigma) { return 1.0 / square(std::max(sigma, kFixed)); }

/// The terms of one linearisation, each of which adds itself to a system.
struct Assembler {
  const FitProblem& problem;
  const FitState& state;
  const PerFrame<FrameKinematics>& motion;
  const PerFrame<FootPositions>& feet;
  const Contacts& contacts;
  Detections detections;

  double time_scale() const { return kReferenceFps / problem.fps; }
  void keypoints(int t, const DetectionRows& before, const DetectionRows& now, BorderedBand& system) const;
  void globals(BorderedBand& system) const;
  void priors(int t, BorderedBand& system) const;
  void smoothness(int t, BorderedBand& system) const;
  template <int N, class Jacobian>
  void add_differences(const Jacobian& jacobian, const DifferenceWeights<N>& w, BorderedBand& system) const;
  void acceleration(BorderedBand& system) const;
  double standing_weight(int t, int i) const;
  void standing(int t, BorderedBand& system) const;
  void slipping(BorderedBand& system) const;
  void border(int first, std::span<Eigen::MatrixXd> rows) const;
};

/// Projected joints against detections: the innovation of a frame's error after the frame before.
void Assembler::keypoints(int t, const DetectionRows& before, const DetectionRows& now,
                          BorderedBand& system) const {
  const Innovation innovation = detections.innovation(t, before, now);
  system.diagonal[t].noalias() += now.J.transpose() * (innovation.own.asDiagonal() * now.J);
  if (t > 0) {
    system.next[t - 1].noalias() -=
        now.J.transpose() * (innovation.here.cwiseProduct(innovation.kept).asDiagonal() * before.J);
    system.rhs[t - 1].noalias() +=
        (innovation.kept.asDiagonal() * before.J).eval().transpose() * innovation.r;
  }
  system.rhs[t].noalias() -= (innovation.here.asDiagonal() * now.J).eval().transpose() * innovation.r;
  system.corner.topLeftCorner<kFirstOffset, kFirstOffset>().noalias() +=
      innovation.G.transpose() * innovation.G;
  system.rhs_border.head<kFirstOffset>().noalias() -= innovation.G.transpose() * innovation.r;
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    const int at = offset_of(k);
    const Eigen::Matrix<double, kOffsets, 2> offsets = innovation.O.middleRows<2>(row).transpose();
    const Eigen::Matrix<double, kOffsets, kFirstOffset> shared = offsets * innovation.G.middleRows<2>(row);
    system.corner.block<kOffsets, kFirstOffset>(at, 0) += shared;
    system.corner.block<kFirstOffset, kOffsets>(0, at) += shared.transpose();
    system.corner.block<kOffsets, kOffsets>(at, at) += offsets * offsets.transpose();
    system.rhs_border.segment<kOffsets>(at) -= offsets * innovation.r.segment<2>(row);
  }
}

void Assembler::globals(BorderedBand& system) const {
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

void Assembler::priors(int t, BorderedBand& system) const {
  const FrameVector weight = correction_levels(problem).size.array().square().inverse();
  system.diagonal[t].diagonal() += weight;
  system.rhs[t] -= weight.cwiseProduct(state.c[t]);
}

/// First and second differences of the corrections; the input's own jitter is added to their σ.
void Assembler::smoothness(int t, BorderedBand& system) const {
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

/// Adds differences of points over frames, some frames at a time: the derivatives of all frames would take as
/// much memory as a third of the system.
/// @param jacobian  derivative of the points' coordinates in frame t, by that frame's unknowns
template <int N, class Jacobian>
void Assembler::add_differences(const Jacobian& jacobian, const DifferenceWeights<N>& w,
                                BorderedBand& system) const {
  const int frames = problem.frames();
  constexpr int kFrames = 16;  // a chunk; every frame writes its own blocks
  parallel_for((frames + kFrames - 1) / kFrames, problem.config.threads, [&](int chunk) {
    const int first = chunk * kFrames, last = std::min(first + kFrames, frames);
    PerFrame<PointsJacobian<N>> chunk_of_J;  // and of the two frames behind it
    for (int t = first; t < std::min(last + 2, frames); ++t) chunk_of_J.push_back(jacobian(t));
    const auto J = [&](int t) -> const PointsJacobian<N>& { return chunk_of_J[t - first]; };
    for (int t = first; t < last; ++t) {
      system.diagonal[t].noalias() += J(t).transpose() * (w.diagonal[t].asDiagonal() * J(t));
      if (t + 1 < frames) system.next[t].noalias() += J(t + 1).transpose() * (w.next[t].asDiagonal() * J(t));
      if (w.has_second && t + 2 < frames)
        system.second[t].noalias() += J(t + 2).transpose() * (w.second[t].asDiagonal() * J(t));
      system.rhs[t].noalias() += J(t).transpose() * w.pull[t];
    }
  });
}

/// Second differences of all joint positions. The shape's influence on accelerations is left out.
void Assembler::acceleration(BorderedBand& system) const {
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
  const auto jacobian = [&](int t) {
    PointsJacobian<kBodies> J;
    for (int b = 0; b < kBodies; ++b)
      J.middleRows<3>(3 * b) = point_jacobian(motion[t], b, motion[t].poses.p_WB[b]);
    return J;
  };
  add_differences<kBodies>(jacobian, weights, system);
}

/// Height of a foot point over the ground that its foot stands on, m.
double height_over_ground(const Scene& scene, const FootPositions& feet, int i) {
  return scene.flat() ? feet[i].z() : scene.clearance(feet[i], sole_middle(feet, i));
}

/// Weight of the height of a foot point: where it stands, and where it is below the floor. Else 0.
double Assembler::standing_weight(int t, int i) const {
  const double z = height_over_ground(problem.scene, feet[t], i);
  double w = 0.0;
  if (contacts[t][i]) w += information(problem.config.floor_sigma) * cauchy(z * z, kFloorKernel);
  if (z < 0.0) w += information(problem.config.penetration_sigma);
  return w;
}

/// Derivative of a foot point's height by the unknowns of the frame and by the shape.
struct HeightJacobian {
  Eigen::RowVectorXd J;
  Eigen::Matrix<double, 1, kBetas> G;

  HeightJacobian(const FitProblem& problem, const FrameKinematics& k, const FootPositions& feet, int i) {
    const auto& [body, by_beta] = problem.foot_points[i];
    J = point_jacobian(k, body, feet[i]).row(2);
    G = (k.by_beta[body] + k.R[body] * by_beta).row(2);
  }
};

/// Heights of the foot points over the ground: 0 where they stand, nowhere below 0.
void Assembler::standing(int t, BorderedBand& system) const {
  for (int i = 0; i < kFootPoints; ++i) {
    const double z = height_over_ground(problem.scene, feet[t], i), w = standing_weight(t, i);
    if (w == 0.0) continue;
    const auto [J, G] = HeightJacobian(problem, motion[t], feet[t], i);
    system.diagonal[t].noalias() += w * J.transpose() * J;
    system.corner.block<kBetas, kBetas>(kFirstBeta, kFirstBeta).noalias() += w * G.transpose() * G;
    system.rhs[t].noalias() -= w * z * J.transpose();
    system.rhs_border.segment<kBetas>(kFirstBeta).noalias() -= w * z * G.transpose();
  }
}

/// The border: derivatives of detections and heights by the clip's unknowns.
void Assembler::border(int first, std::span<Eigen::MatrixXd> rows) const {
  DetectionRows before, now = first > 0 ? detections.rows(first - 1) : DetectionRows{};
  const int end = first + static_cast<int>(rows.size());
  for (int t = first; t <= std::min(end, problem.frames() - 1); ++t) {
    std::swap(before, now);
    now = detections.rows(t);
    const Innovation innovation = detections.innovation(t, before, now);
    const auto at = static_cast<std::size_t>(t - first);
    if (t > first)
      detections.add_border(-(innovation.kept.asDiagonal() * before.J).eval(), innovation, rows[at - 1]);
    if (t == end) break;
    rows[at].setZero(kFrameUnknowns, problem.globals());
    detections.add_border(innovation.here.asDiagonal() * now.J, innovation, rows[at]);
    for (int i = 0; i < kFootPoints; ++i) {
      const double w = standing_weight(t, i);
      if (w == 0.0) continue;
      const auto [J, G] = HeightJacobian(problem, motion[t], feet[t], i);
      rows[at].middleCols<kBetas>(kFirstBeta).noalias() += w * J.transpose() * G;
    }
  }
}

/// A point that stands in this frame and the next does not move. The shape's influence is left out.
void Assembler::slipping(BorderedBand& system) const {
  const int frames = problem.frames();
  const double sigma = time_scale() * problem.config.slip_sigma;
  DifferenceWeights<kFootPoints> weights(frames, false);
  const auto stays = [&](int t, int i) {
    return t >= 0 && t + 1 < frames && contacts[t][i] && contacts[t + 1][i];
  };
  for (int t = 0; t < frames; ++t)
    for (int i = 0; i < kFootPoints; ++i) {
      if (!stays(t, i)) continue;
      const Vector3d d = feet[t + 1][i] - feet[t][i];
      const double w = information(sigma) * cauchy(d.squaredNorm(), kSlipKernel * sigma);
      weights.diagonal[t].segment<3>(3 * i).array() += w;
      weights.diagonal[t + 1].segment<3>(3 * i).array() += w;
      weights.next[t].segment<3>(3 * i).array() -= w;
      weights.pull[t].segment<3>(3 * i) += w * d;
      weights.pull[t + 1].segment<3>(3 * i) -= w * d;
    }
  const auto jacobian = [&](int t) {
    PointsJacobian<kFootPoints> J = PointsJacobian<kFootPoints>::Zero();
    for (int i = 0; i < kFootPoints; ++i)
      if (stays(t, i) || stays(t - 1, i))
        J.middleRows<3>(3 * i) = point_jacobian(motion[t], problem.foot_points[i].body, feet[t][i]);
    return J;
  };
  add_differences<kFootPoints>(jacobian, weights, system);
}

/// Adds the normal equations of frame t that keep joints inside their ranges (docs/method.md, "Keypoint fit",
/// (7)): the squared distances beyond them (character/joint_range.h) over `range_sigma`². @param k kinematics
/// of the frame
void add_ranges(const FitProblem& problem, const FrameKinematics& k, int t, BorderedBand& system) {
  const double weight = 1.0 / square(kDegree * problem.config.range_sigma);
  for (int b = 1; b < kBodies; ++b) {
    const Quaterniond q = k.poses.q_WB[kParents[b]].conjugate() * k.poses.q_WB[b];
    const RangeDistance range = range_distance(problem.joint[b], b, q);
    if (range.excess <= 0.0) continue;
    // The joint's correction turns it by M in the world; of a hinge this is one column.
    const int at = kFirstJoint + first_dof(b), count = is_hinge(b) ? 1 : 3;
    const Eigen::VectorXd J = (k.M[b].transpose() * (k.R[b] * range.slope)).head(count);
    system.diagonal[t].block(at, at, count, count).noalias() += weight * J * J.transpose();
    system.rhs[t].segment(at, count) -= weight * range.excess * J;
  }
}

}  // namespace

NormalEquations linearise(const FitProblem& problem, const FitState& state,
                          const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                          const Contacts& contacts) {
  const Assembler terms{problem,  state,
                        motion,   feet,
                        contacts, {problem, state, motion, detection_weights(problem, state, motion)}};
  BorderedBand system(problem.frames(), kFrameUnknowns, problem.globals());
  terms.globals(system);
  DetectionRows before, now;
  for (int t = 0; t < problem.frames(); ++t) {
    std::swap(before, now);
    now = terms.detections.rows(t);
    terms.keypoints(t, before, now, system);
    terms.priors(t, system);
    terms.smoothness(t, system);
    terms.standing(t, system);
    add_ranges(problem, motion[t], t, system);
  }
  terms.slipping(system);
  if (problem.penalises_acceleration) terms.acceleration(system);
  return {std::move(system),
          [terms](int first, std::span<Eigen::MatrixXd> rows) { terms.border(first, rows); }};
}

}  // namespace mimicx::fit
