#include "motion/fit/terms.h"

#include <gtest/gtest.h>

#include "motion/estimator_error.h"
#include "motion/fit/projection.h"
#include "motion/fit/random_problems.h"

namespace mimicx::motion::fit {
namespace {

using namespace test;
using Eigen::MatrixXd;

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
      const int body = problem.points[k].body;
      const double sigma = o.keypoint_sigma * (body == kLeftWrist || body == kRightWrist ? 3.0 : 1.0);
      const double confidence = problem.uvc[t][k].z();
      const Projection was = project_point(problem, weights_at, t, k, frozen.motion[t].poses.p_WB[body]);
      add(project_point(problem, s, t, k, m.motion[t].poses.p_WB[body]).error,
          confidence * confidence / sigma * kernel(was.error.squaredNorm(), o.keypoint_kernel));
    }
    for (int i = 0; i < kFrameUnknowns; ++i) {
      double size = o.root_position_sigma, rate = o.root_rate, bend = o.root_bend,
             jitter = problem.position_jitter;
      if (i >= kRootRotation) {
        double w = 1.0;
        for (int b = 1; b < kBodies; ++b)
          if (i >= kFirstJoint + first_dof(b)) w = relative_joint_error(b);
        size = degree * (i < kFirstJoint ? o.root_rotation_sigma : w * o.joint_sigma);
        rate = w * degree * o.joint_rate, bend = w * degree * o.joint_bend,
        jitter = w * problem.rotation_jitter;
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
  add(s.g.segment<kBetas>(kFirstBeta), told / o.beta_sigma);
  add(s.g.tail(s.g.size() - kFirstOffset), 1.0 / o.keypoint_bias_sigma);
  return Eigen::Map<const VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
}

struct Dense {
  MatrixXd H;
  VectorXd rhs;
};

Dense dense_of(const BorderedBand& s) {
  const auto n = s.diagonal[0].rows(), m = s.corner.rows(),
             size = static_cast<Eigen::Index>(s.diagonal.size()) * n;
  Dense d{MatrixXd::Zero(size + m, size + m), VectorXd::Zero(size + m)};
  for (std::size_t t = 0; t < s.diagonal.size(); ++t) {
    const auto at = static_cast<Eigen::Index>(t) * n;
    d.H.block(at, at, n, n) = s.diagonal[t];
    if (t + 1 < s.diagonal.size()) d.H.block(at + n, at, n, n) = s.next[t];
    if (t + 2 < s.diagonal.size()) d.H.block(at + 2 * n, at, n, n) = s.second[t];
    d.H.block(size, at, m, n) = s.border[t].transpose();
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
  const FitState state = test::random_state(problem, 3, 0.01);
  const test::Moved m = test::move(problem, state);
  Contacts contacts(4);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i) contacts[t][i] = (t + i) % 3 != 0;
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
  // Without the two terms that leave the shape's influence out, the border is exact as well.
  problem.config.acceleration_sigma = problem.config.slip_sigma = 1e3;
  compare(true);
}

}  // namespace
}  // namespace mimicx::motion::fit
