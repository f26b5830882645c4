#include "motion/fit/problem.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/estimator_error.h"
#include "motion/made_motions.h"
#include "motion/synth/noise.h"

namespace mimicx {
namespace {

using namespace test;
using Eigen::MatrixXd;

/// A few frames of random motion with detections by a camera in front of it.
FitProblem random_problem(std::uint64_t seed, int frames, const FitOptions& options) {
  Clip clip = random_clip(seed, frames, 0.15);
  Camera camera;
  camera.intrinsics << 900, 2, 640, 0, 950, 360, 0, 0, 1;
  camera.extrinsics.block<3, 3>(0, 0) << 1, 0, 0, 0, 0.1, -std::sqrt(0.99), 0, std::sqrt(0.99), 0.1;
  camera.extrinsics.block<3, 1>(0, 3) = Vector3d(0.1, 1.2, 4.5);
  clip.keypoints = detect_keypoints(poses_of(clip), camera, KeypointSet::kJoints22, {}, seed, clip.fps);
  return make_problem(clip, options);
}

FitState random_state(const FitProblem& problem, std::uint64_t seed, double size) {
  Random random(seed, {7});
  FitState state = initial_state(problem);
  for (FrameVector& c : state.c)
    for (double& x : c) x = size * random.normal();
  for (double& x : state.g) x = 0.02 * random.normal();
  return state;
}

struct Moved {
  std::vector<FrameKinematics> motion;
  std::vector<FootPositions> feet;
};

Moved move(const FitProblem& problem, const FitState& state) {
  const Character character = character_of(problem, state);
  Moved m;
  for (std::size_t t = 0; t < problem.q.size(); ++t) {
    m.motion.push_back(kinematics(problem, state, character, t));
    FootPositions& feet = m.feet.emplace_back();
    const std::vector<Vector3d> surface = surface_positions(surface_points(character), m.motion.back().poses);
    for (std::size_t i = 0; i < kFootPoints; ++i) feet[i] = surface[i];
  }
  return m;
}

/// Every unknown of a state in one row: frames first, then the clip's.
double& unknown(FitState& state, Eigen::Index i) {
  const auto frames = static_cast<Eigen::Index>(state.c.size());
  if (i >= frames * kFrameUnknowns) return state.g[i - frames * kFrameUnknowns];
  return state.c[static_cast<std::size_t>(i / kFrameUnknowns)][i % kFrameUnknowns];
}

/// Derivative of a vector function of the state by central differences.
template <class Function>
MatrixXd finite_differences(const FitState& at, Function function) {
  const auto size = static_cast<Eigen::Index>(at.c.size()) * kFrameUnknowns + at.g.size();
  constexpr double kStep = 1e-6;
  MatrixXd J;
  for (Eigen::Index i = 0; i < size; ++i) {
    FitState up = at, down = at;
    unknown(up, i) += kStep;
    unknown(down, i) -= kStep;
    const VectorXd column = (function(up) - function(down)) / (2.0 * kStep);
    if (i == 0) J.resize(column.size(), size);
    J.col(i) = column;
  }
  return J;
}

TEST(FitKinematics, PointDerivativesMatchFiniteDifferences) {
  const FitProblem problem = random_problem(1, 1, {});
  const FitState state = random_state(problem, 1, 0.2);
  const Moved m = move(problem, state);
  const MatrixXd joints = finite_differences(state, [&](const FitState& s) {
    VectorXd p(3 * kBodies);
    for (std::size_t b = 0; b < kBodies; ++b)
      p.segment<3>(3 * static_cast<int>(b)) = move(problem, s).motion[0].poses.p_WB[b];
    return p;
  });
  const MatrixXd feet = finite_differences(state, [&](const FitState& s) {
    VectorXd p(3 * kFootPoints);
    for (std::size_t i = 0; i < kFootPoints; ++i)
      p.segment<3>(3 * static_cast<int>(i)) = move(problem, s).feet[0][i];
    return p;
  });
  for (int b = 0; b < kBodies; ++b) {
    const auto i = static_cast<std::size_t>(b);
    const PointJacobian J = point_jacobian(m.motion[0], b, m.motion[0].poses.p_WB[i]);
    EXPECT_LT((J - joints.block(3 * b, 0, 3, kFrameUnknowns)).norm(), 1e-7) << kBodyNames[i];
    EXPECT_LT((m.motion[0].by_beta[i] - joints.block(3 * b, kFrameUnknowns + kFirstBeta, 3, kBetas)).norm(),
              1e-7)
        << kBodyNames[i];
  }
  for (std::size_t i = 0; i < kFootPoints; ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    const auto body = static_cast<std::size_t>(foot_body(i));
    EXPECT_LT(
        (point_jacobian(m.motion[0], foot_body(i), m.feet[0][i]) - feet.block(row, 0, 3, kFrameUnknowns))
            .norm(),
        1e-7);
    EXPECT_LT((m.motion[0].by_beta[body] + m.motion[0].R[body] * problem.foot_by_beta[i] -
               feet.block(row, kFrameUnknowns + kFirstBeta, 3, kBetas))
                  .norm(),
              1e-7);
  }
}

TEST(FitProjection, DerivativesMatchFiniteDifferences) {
  FitOptions options;
  const FitProblem problem = random_problem(2, 1, options);
  const FitState state = random_state(problem, 2, 0.1);
  const auto errors = [&](const FitState& s) {
    const Moved m = move(problem, s);
    VectorXd e(2 * static_cast<Eigen::Index>(problem.points.size()));
    for (std::size_t k = 0; k < problem.points.size(); ++k)
      e.segment<2>(2 * static_cast<Eigen::Index>(k)) =
          project_point(problem, s, 0, k,
                        m.motion[0].poses.p_WB[static_cast<std::size_t>(problem.points[k].body)])
              .error;
    return e;
  };
  const MatrixXd expected = finite_differences(state, errors);
  const Moved m = move(problem, state);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const int body = problem.points[k].body;
    const Vector3d& p = m.motion[0].poses.p_WB[static_cast<std::size_t>(body)];
    const Projection seen = project_point(problem, state, 0, k, p);
    ASSERT_TRUE(seen.valid);
    const auto row = 2 * static_cast<Eigen::Index>(k);
    const auto column = [&](int global) { return expected.block<2, 1>(row, kFrameUnknowns + global); };
    EXPECT_LT((seen.by_tilt - column(kTilt)).norm(), 1e-7);
    EXPECT_LT((seen.by_focal - column(kLogFocal)).norm(), 1e-7);
    EXPECT_LT(
        (seen.by_point * point_jacobian(m.motion[0], body, p) - expected.block(row, 0, 2, kFrameUnknowns))
            .norm(),
        1e-7);
    EXPECT_LT(
        (expected.block<2, 2>(row, kFrameUnknowns + kFirstOffset + row) - Eigen::Matrix2d::Identity()).norm(),
        1e-7);
  }
}

TEST(FitProjection, APointBehindTheCameraIsNotSeen) {
  const FitProblem problem = random_problem(2, 1, {});
  EXPECT_FALSE(project_point(problem, initial_state(problem), 0, 0, {0, -50, 1}).valid);
}

/// All residuals of the fit, written down once more: each divided by its σ, its kernel's weight frozen at
/// `weights_at`.
VectorXd residuals(const FitProblem& problem, const FitState& s, const FitState& weights_at,
                   const Contacts& contacts) {
  const FitOptions& o = problem.options;
  const Moved m = move(problem, s), frozen = move(problem, weights_at);
  const double degree = kPi / 180.0;
  std::vector<double> r;
  const auto add = [&](const auto& values, double scale) {
    for (double x : values) r.push_back(scale * x);
  };
  const auto kernel = [](double squares, double width) {
    return std::sqrt(1.0 / (1.0 + squares / (width * width)));
  };
  const std::size_t frames = problem.q.size();
  for (std::size_t t = 0; t < frames; ++t) {
    for (std::size_t k = 0; k < problem.points.size(); ++k) {
      const int body = problem.points[k].body;
      const auto b = static_cast<std::size_t>(body);
      const double sigma = o.keypoint_sigma * (body == kLeftWrist || body == kRightWrist ? 3.0 : 1.0);
      const double confidence = problem.uvc[t][k].z();
      const Projection was = project_point(problem, weights_at, t, k, frozen.motion[t].poses.p_WB[b]);
      add(project_point(problem, s, t, k, m.motion[t].poses.p_WB[b]).error,
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
      const auto bent = [&](const Moved& at) {
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
  FitProblem problem = random_problem(3, 4, {});
  for (Vector3d& p : problem.p_root) p.z() -= 0.02;  // some foot points below the floor, some above
  const FitState state = random_state(problem, 3, 0.01);
  const Moved m = move(problem, state);
  Contacts contacts(4);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i) contacts[t][i] = (t + i) % 3 != 0;
  const auto compare = [&](bool with_globals) {
    const Dense found = dense_of(linearise(problem, state, m.motion, m.feet, contacts));
    const auto at = [&](const FitState& s) { return residuals(problem, s, state, contacts); };
    const MatrixXd J = finite_differences(state, at);
    const MatrixXd H = J.transpose() * J;
    const VectorXd rhs = -J.transpose() * at(state);
    const Eigen::Index size = with_globals ? H.rows() : 4 * kFrameUnknowns;
    EXPECT_LT(mismatch(found.H.topLeftCorner(size, size), H.topLeftCorner(size, size)), 1e-6);
    EXPECT_LT((found.rhs.head(size) - rhs.head(size)).norm(), 1e-6 * rhs.norm());
  };
  compare(false);
  // Without the two terms that leave the shape's influence out, the border is exact as well.
  problem.options.acceleration_sigma = problem.options.slip_sigma = 1e3;
  compare(true);
}

TEST(FitContacts, APlantedFootStandsAndASwingingOneDoesNot) {
  std::vector<FootPositions> feet(30);
  for (std::size_t t = 0; t < feet.size(); ++t)
    for (std::size_t i = 0; i < kFootPoints; ++i)
      feet[t][i] =
          i < kFootPoints / 2 ? Vector3d(0, 0, 0.005) : Vector3d(0.05 * static_cast<double>(t), 0, 0.005);
  for (bool settled : {true, false}) {
    const Contacts contacts = find_contacts(feet, 30.0, settled);
    for (const auto& frame : contacts)
      for (std::size_t i = 0; i < kFootPoints; ++i) EXPECT_EQ(frame[i], i < kFootPoints / 2);
  }
  for (FootPositions& frame : feet)
    for (Vector3d& p : frame) p.z() += 0.2;  // an estimate that floats
  EXPECT_FALSE(find_contacts(feet, 30.0, true)[10][0]);
  EXPECT_TRUE(find_contacts(feet, 30.0, false)[10][0]);
}

}  // namespace
}  // namespace mimicx
