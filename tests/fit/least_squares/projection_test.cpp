#include "fit/least_squares/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/least_squares/random_problems.h"

namespace mimicx::fit {
namespace {

using namespace test;
using Eigen::MatrixXd;

TEST(FitProjection, ErrorIsThePinholeProjectionErrorInBoxHeights) {
  const FitProblem problem = test::random_problem(2, 2, {});
  const FitState state = test::random_state(problem, 2, 0.1);
  const Matrix3d& K = problem.intrinsics;
  const Eigen::Matrix4d& E = problem.extrinsics[0];
  const auto pixel = [&](const Vector3d& p_W, double tilt, double focal) {
    const Vector3d p = E.topLeftCorner<3, 3>() * p_W + E.topRightCorner<3, 1>();
    const double y = std::cos(tilt) * p.y() - std::sin(tilt) * p.z(),
                 z = std::sin(tilt) * p.y() + std::cos(tilt) * p.z();
    return Eigen::Vector2d(focal * (K(0, 0) * p.x() + K(0, 1) * y) / z + K(0, 2),
                           focal * K(1, 1) * y / z + K(1, 2));
  };
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);  // of the input in frame 1, by the camera of the file
  for (const Vector3d& p : forward_kinematics(make_character(), problem.p_root[1], problem.q[1]).p_WB) {
    low = low.cwiseMin(pixel(p, 0.0, 1.0));
    high = high.cwiseMax(pixel(p, 0.0, 1.0));
  }
  const double box = std::max(high.x() - low.x(), high.y() - low.y());
  const Vector3d v(0.3, -0.2, 0.1);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const Vector3d p(0.1, 0.2, 0.04 * static_cast<double>(k));
    const Eigen::Vector2d offset = state.g.segment<2>(offset_of(k)),
                          seen = pixel(p + state.g[kLead] * v, state.g[kTilt], std::exp(state.g[kLogFocal]));
    const Projection found = project_point(problem, state, 1, k, p, v);
    ASSERT_TRUE(found.valid);
    EXPECT_LT((found.error - (seen - problem.uvc[1][k].head<2>()) / box - offset).norm(), 1e-10);
  }
}

/// @param set  of the keypoints
void expect_derivatives(motion::KeypointSet set) {
  const FitProblem problem = test::random_problem(2, 1, {}, set);
  const FitState state = test::random_state(problem, 2, 0.1);
  const auto errors = [&](const FitState& s) {
    const test::Moved m = test::move(problem, s);
    VectorXd e(2 * static_cast<Eigen::Index>(problem.points.size()));
    for (std::size_t k = 0; k < problem.points.size(); ++k)
      e.segment<2>(2 * static_cast<Eigen::Index>(k)) = keypoint_error(problem, s, m.motion, 0, k).error;
    return e;
  };
  const MatrixXd expected = test::finite_differences(state, errors);
  const test::Moved m = test::move(problem, state);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const KeypointDerivatives found = keypoint_derivatives(problem, state, m.motion, 0, k);
    ASSERT_TRUE(found.seen.valid);
    const auto row = 2 * static_cast<Eigen::Index>(k);
    EXPECT_LT((found.by_frame - expected.block<2, kFrameUnknowns>(row, 0)).norm(), 1e-7);
    EXPECT_LT((found.by_clip - expected.block<2, kFirstOffset>(row, kFrameUnknowns)).norm(), 1e-7);
    EXPECT_LT((found.by_offset - expected.block<2, kOffsets>(row, kFrameUnknowns + offset_of(k))).norm(),
              1e-7);
  }
}

TEST(FitProjection, DerivativesMatchFiniteDifferences) {
  for (const motion::KeypointSet set : {motion::KeypointSet::kJoints22, motion::KeypointSet::kCoco133})
    expect_derivatives(set);
}

TEST(FitProjection, LeadShiftsTheMotionInTime) {
  const FitProblem problem = test::random_problem(2, 3, {});
  FitState state = initial_state(problem);
  const test::Moved m = test::move(problem, state);
  for (std::size_t k = 0; k < problem.points.size(); ++k) {
    const int body = problem.points[k].body;
    const Vector3d v = 0.5 * (m.motion[2].poses.p_WB[body] - m.motion[0].poses.p_WB[body]);
    state.g[kLead] = 0.6;
    const Eigen::Vector2d late = keypoint_error(problem, state, m.motion, 1, k).error;
    state.g[kLead] = 0.0;
    const Vector3d p = m.motion[1].poses.p_WB[body] + 0.6 * v;
    EXPECT_LT((late - project_point(problem, state, 1, k, p, Vector3d::Zero()).error).norm(), 1e-12);
  }
}

TEST(FitProjection, PointBehindTheCameraIsInvalid) {
  const FitProblem problem = test::random_problem(2, 1, {});
  EXPECT_FALSE(project_point(problem, initial_state(problem), 0, 0, {0, -50, 1}, {0, 0, 0}).valid);
}

}  // namespace
}  // namespace mimicx::fit
