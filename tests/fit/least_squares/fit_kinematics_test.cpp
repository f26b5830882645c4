#include "fit/least_squares/fit_kinematics.h"

#include <gtest/gtest.h>

#include "fit/least_squares/random_problems.h"

namespace mimicx::fit {
namespace {

using namespace test;
using Eigen::MatrixXd;

TEST(FitKinematics, PointDerivativesMatchFiniteDifferences) {
  const FitProblem problem = test::random_problem(1, 1, {});
  const FitState state = test::random_state(problem, 1, 0.2);
  const test::Moved m = test::move(problem, state);
  const MatrixXd joints = test::finite_differences(state, [&](const FitState& s) {
    VectorXd p(3 * kBodies);
    for (int b = 0; b < kBodies; ++b) p.segment<3>(3 * b) = test::move(problem, s).motion[0].poses.p_WB[b];
    return p;
  });
  const MatrixXd feet = test::finite_differences(state, [&](const FitState& s) {
    VectorXd p(3 * kFootPoints);
    for (int i = 0; i < kFootPoints; ++i) p.segment<3>(3 * i) = test::move(problem, s).feet[0][i];
    return p;
  });
  for (int b = 0; b < kBodies; ++b) {
    const PointJacobian J = point_jacobian(m.motion[0], b, m.motion[0].poses.p_WB[b]);
    EXPECT_LT((J - joints.block(3 * b, 0, 3, kFrameUnknowns)).norm(), 1e-7) << kBodyNames[b];
    EXPECT_LT((m.motion[0].by_beta[b] - joints.block(3 * b, kFrameUnknowns + kFirstBeta, 3, kBetas)).norm(),
              1e-7)
        << kBodyNames[b];
  }
  for (int i = 0; i < kFootPoints; ++i) {
    const auto& [body, by_beta] = problem.foot_points[i];
    EXPECT_LT(
        (point_jacobian(m.motion[0], body, m.feet[0][i]) - feet.block(3 * i, 0, 3, kFrameUnknowns)).norm(),
        1e-7);
    EXPECT_LT((m.motion[0].by_beta[body] + m.motion[0].R[body] * by_beta -
               feet.block(3 * i, kFrameUnknowns + kFirstBeta, 3, kBetas))
                  .norm(),
              1e-7);
  }
}

TEST(FitKinematics, FootPointsAreTheSurfacePointsOfTheSoles) {
  const FitProblem problem = test::random_problem(4, 1, {});
  const FitState state = test::random_state(problem, 4, 0.2);
  const Character character = character_of(problem, state);
  const FrameKinematics k = kinematics(problem, state, character, 0);
  const std::vector<Vector3d> surface = motion::surface_positions(motion::surface_points(character), k.poses);
  const FootPositions feet = foot_positions(character, k);
  ASSERT_GE(surface.size(), feet.size());
  for (std::size_t i = 0; i < feet.size(); ++i) EXPECT_LT((feet[i] - surface[i]).norm(), 1e-12) << i;
}

}  // namespace
}  // namespace mimicx::fit
