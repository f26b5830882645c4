#include "fit/least_squares/fit_terms.h"

#include <gtest/gtest.h>

#include "fit/least_squares/projection.h"
#include "fit/least_squares/random_problems.h"

namespace mimicx::fit {
namespace {

using namespace test;
using Eigen::MatrixXd;

/// Distance of a joint beyond its range, rad; below 0 inside.                       docs/physics.md §3
double beyond(const FitProblem& problem, const FitState& state, int t, int body) {
  const JointParameters& j = problem.joint[body];
  const Vector3d centre = is_hinge(body) ? Vector3d(j.centre.x() * hinge_axis(body)) : j.centre;
  const Quaterniond x = exp_map(centre).conjugate() * rotations_of(problem, state, t)[body];
  const Vector3d chord = (2.0 * (0.5 * j.half_range.array()).sin()).matrix();
  const Vector3d s = (x.w() < 0.0 ? -2.0 : 2.0) * x.vec().cwiseQuotient(chord);
  return (s.norm() - 1.0) / (s.cwiseQuotient(chord) / s.norm()).norm();
}

/// All residuals of the fit, written down once more: each divided by its σ, its kernel's weight frozen at
/// `weights_at`.
VectorXd residuals(const FitProblem& problem, const FitState& s, const FitState& weights_at,
                   const Contacts& contacts) {
  const FitConfig& o = problem.config;
  const test::Moved m = test::move(problem, s), frozen = test::move(problem, weights_at);
  const double degree = test::kPi / 180.0;
  std::vector<double> r;
  const auto add = [&](const auto& values, double scale) {
    for (double x : values) r.push_back(scale * x);
  };
  const auto kernel = [](double squares, double width) {
    return std::sqrt(1.0 / (1.0 + squares / (width * width)));
  };
  const int frames = problem.frames();
  for (int t = 0; t < frames; ++t) {
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      const auto scaled = [&](int at) -> Eigen::Vector2d {
        const double confidence = problem.uvc[at][k].z();
        if (confidence <= 0.0) return Eigen::Vector2d::Zero();
        const double plain =
            std::pow(confidence, problem.levels.confidence_power) / problem.levels.keypoint[k];
        const double was = keypoint_error(problem, weights_at, frozen.motion, at, k).error.squaredNorm();
        const double weight =
            problem.settled ? std::sqrt(6.0 / (4.0 + plain * plain * was)) : kernel(was, o.keypoint_kernel);
        return plain * weight * keypoint_error(problem, s, m.motion, at, k).error;
      };
      const bool follows = t > 0 && problem.uvc[t][k].z() > 0.0 && problem.uvc[t - 1][k].z() > 0.0;
      const double c = follows ? o.keypoint_correlation : 0.0;
      Eigen::Vector2d fresh = scaled(t);
      if (follows) fresh -= c * scaled(t - 1);
      add(fresh, 1.0 / std::sqrt(1.0 - c * c));
    }
    for (int i = 0; i < kFrameUnknowns; ++i) {
      double size = o.root_position_sigma, rate = o.root_rate, bend = o.root_bend,
             jitter = problem.position_jitter;
      if (i >= kRootRotation) {
        jitter = problem.rotation_jitter;
        for (int b = 1; b < kBodies; ++b)
          if (i >= kFirstJoint + first_dof(b) && i < kFirstJoint + first_dof(b) + (is_hinge(b) ? 1 : 3))
            jitter = problem.joint_jitter[b];
        size = degree * (i < kFirstJoint ? o.root_rotation_sigma : o.joint_sigma);
        rate = degree * o.joint_rate, bend = degree * o.joint_bend;
      }
      r.push_back(s.c[t][i] / size / std::sqrt(o.prior_frames));
      if (t + 1 < frames)
        r.push_back((s.c[t + 1][i] - s.c[t][i]) / std::sqrt(rate * rate + 2 * jitter * jitter));
      if (t + 2 < frames)
        r.push_back((s.c[t + 2][i] - 2 * s.c[t + 1][i] + s.c[t][i]) /
                    std::sqrt(bend * bend + 6 * jitter * jitter));
    }
    for (std::size_t i = 0; i < kFootPoints; ++i) {
      const double z = frozen.feet[t][i].z();
      if (contacts[t][i]) r.push_back(m.feet[t][i].z() / o.floor_sigma * kernel(z * z, 0.03));
      if (z < 0.0) r.push_back(m.feet[t][i].z() / o.penetration_sigma);
      if (t + 1 < frames && contacts[t][i] && contacts[t + 1][i])
        add((m.feet[t + 1][i] - m.feet[t][i]).eval(),
            kernel((frozen.feet[t + 1][i] - frozen.feet[t][i]).squaredNorm(), 5 * o.slip_sigma) /
                o.slip_sigma);
    }
    for (int b = 1; b < kBodies; ++b)
      if (beyond(problem, weights_at, t, b) > 0.0)
        r.push_back(beyond(problem, s, t, b) / (degree * o.range_sigma));
    for (std::size_t b = 0; b < kBodies && t + 2 < frames; ++b) {
      const auto bent = [&](const test::Moved& at) {
        return Vector3d(at.motion[t].poses.p_WB[b] - 2 * at.motion[t + 1].poses.p_WB[b] +
                        at.motion[t + 2].poses.p_WB[b]);
      };
      add(bent(m), kernel(bent(frozen).squaredNorm(), 3 * o.acceleration_sigma) / o.acceleration_sigma);
    }
  }
  const double told = std::sqrt(o.told_weight);
  r.push_back(told * s.g[kTilt] / (degree * o.tilt_sigma));
  r.push_back(told * s.g[kLogFocal] / o.focal_sigma);
  r.push_back(s.g[kLead] / o.lead_sigma);
  add(s.g.segment<kBetas>(kFirstBeta), told / o.beta_sigma);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    add(s.g.segment<2>(offset_of(k)), 1.0 / o.flat_offset_sigma);
    add(s.g.segment<3>(offset_of(k) + 2), 1.0 / o.limb_offset_sigma);
  }
  return Eigen::Map<const VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
}

struct Dense {
  MatrixXd H;
  VectorXd rhs;
};

Dense dense_of(const NormalEquations& equations) {
  const BorderedBand& s = equations.band;
  const auto n = s.diagonal[0].rows(), m = s.corner.rows(),
             size = static_cast<Eigen::Index>(s.diagonal.size()) * n;
  Dense d{MatrixXd::Zero(size + m, size + m), VectorXd::Zero(size + m)};
  std::vector<MatrixXd> border(s.diagonal.size());
  equations.border(0, std::span(border).first(3));  // in pieces, as the solver asks for it
  equations.border(3, std::span(border).subspan(3));
  for (std::size_t t = 0; t < s.diagonal.size(); ++t) {
    const auto at = static_cast<Eigen::Index>(t) * n;
    d.H.block(at, at, n, n) = s.diagonal[t];
    if (t + 1 < s.diagonal.size()) d.H.block(at + n, at, n, n) = s.next[t];
    if (t + 2 < s.diagonal.size()) d.H.block(at + 2 * n, at, n, n) = s.second[t];
    d.H.block(size, at, m, n) = border[t].transpose();
    d.rhs.segment(at, n) = s.rhs[t];
  }
  d.H.bottomRightCorner(m, m) = s.corner;
  d.H = d.H.selfadjointView<Eigen::Lower>();
  d.rhs.tail(m) = s.rhs_border;
  return d;
}

/// Relative difference of two matrices after scaling unknowns to a unit diagonal.
double mismatch(const MatrixXd& a, const MatrixXd& b) {
  const VectorXd scale = b.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (a - b) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

TEST(FitTerms, NormalEquationsMatchADenseAssemblyByFiniteDifferences) {
  FitProblem problem = test::random_problem(3, 4, {});
  for (Vector3d& p : problem.p_root) p.z() -= 0.02;  // some foot points below the floor, some above
  for (int b = 1; b < kBodies; b += 3)               // some joints inside their ranges, some beyond them
    problem.joint[b].half_range = is_hinge(b) ? Vector3d::Constant(0.1) : Vector3d(0.1, 0.3, 0.15);
  FitState state = test::random_state(problem, 3, 0.01);
  state.g[kLead] = 0.0;  // the derivatives leave out how a correction changes the velocity
  const test::Moved m = test::move(problem, state);
  Contacts contacts(4);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i) contacts[t][i] = (t + i) % 3 != 0;
  int outside = 0;
  for (int t = 0; t < 4; ++t)
    for (int b = 1; b < kBodies; ++b) outside += beyond(problem, state, t, b) > 0.0 ? 1 : 0;
  ASSERT_GT(outside, 8);
  ASSERT_LT(outside, 40);
  const auto compare = [&](bool with_globals) {
    const Dense found = dense_of(linearise(problem, state, m.motion, m.feet, contacts));
    const auto at = [&](const FitState& s) { return residuals(problem, s, state, contacts); };
    const MatrixXd J = test::finite_differences(state, at);
    const MatrixXd H = J.transpose() * J;
    const VectorXd rhs = -J.transpose() * at(state);
    const Eigen::Index size = with_globals ? H.rows() : 4 * kFrameUnknowns;
    EXPECT_LT(mismatch(found.H.topLeftCorner(size, size), H.topLeftCorner(size, size)), 1e-6);
    EXPECT_LT((found.rhs.head(size) - rhs.head(size)).norm(), 1e-6 * rhs.norm());
  };
  compare(false);
  problem.settled = true;
  problem.levels.keypoint[3] = 0.002;
  problem.levels.confidence_power = 1.7;
  problem.uvc[2][5].z() = 0.0;  // not seen
  compare(false);
  // Without the two terms that leave the shape's influence out, the border is exact as well.
  problem.config.acceleration_sigma = problem.config.slip_sigma = 1e3;
  compare(true);
}

}  // namespace
}  // namespace mimicx::fit
