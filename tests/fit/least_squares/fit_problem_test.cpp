#include "fit/least_squares/fit_problem.h"

#include <gtest/gtest.h>

#include "fit/least_squares/projection.h"
#include "fit/least_squares/random_problems.h"
#include "motion/keypoint_names.h"

namespace mimicx::fit {
namespace {

using namespace test;

TEST(FitProblem, CorrectionsTurnJointsInTheirOwnFrames) {
  const FitProblem problem = test::random_problem(5, 2, {});
  const FitState state = test::random_state(problem, 5, 0.3);
  const PerBody<Quaterniond> q = rotations_of(problem, state, 1);
  const FrameVector& c = state.c[1];
  for (int b = 0; b < kBodies; ++b) {
    const int at = b == 0 ? 3 : 6 + first_dof(b);
    if (b > 0 && is_hinge(b)) {
      const double before = log_map(problem.q[1][b]).dot(hinge_axis(b));
      EXPECT_LT((log_map(q[b]) - (before + c[at]) * hinge_axis(b)).norm(), 1e-12) << kBodyNames[b];
    } else {
      const Vector3d turn = c.segment<3>(at);
      const Matrix3d R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
      EXPECT_LT((problem.q[1][b].toRotationMatrix() * R - q[b].toRotationMatrix()).norm(), 1e-12)
          << kBodyNames[b];
    }
  }
  const FrameKinematics k = kinematics(problem, state, character_of(problem, state), 1);
  EXPECT_LT((k.poses.p_WB[0] - (problem.p_root[1] + c.head<3>())).norm(), 1e-12);
}

TEST(FitProblem, ZeroCorrectionIsTheInputWithHinges) {
  const motion::Clip clip = test::random_clip(6, 3, 0.3);
  const FitProblem problem = make_problem(clip, {});
  const PerBody<Quaterniond> q = rotations_of(problem, initial_state(problem), 2);
  for (int b = 0; b < kBodies; ++b) EXPECT_LT(q[b].angularDistance(problem.q[2][b]), 1e-12) << kBodyNames[b];
  EXPECT_LT((problem.p_root[2] - motion::poses_of(clip)[2].p_WB[0]).norm(), 1e-12);
}

TEST(FitProblem, LeavesOutFaceAndFingersAndPairsTheOtherPoints) {
  const FitProblem problem = test::random_problem(4, 2, {}, motion::KeypointSet::kCoco133);
  const std::vector<std::string> names = motion::keypoint_names(motion::KeypointSet::kCoco133);
  ASSERT_EQ(problem.points.size(), 18u);  // 12 joints, 6 points of the feet
  for (const FitPoint& point : problem.points) {
    EXPECT_EQ(names[problem.points[point.mirror].column], motion::mirrored_name(names[point.column]));
    EXPECT_NE(names[point.column], motion::mirrored_name(names[point.column]));
  }
}

TEST(FitProblem, FootPointsStayOnTheFootOfEveryShape) {
  FitProblem problem = test::random_problem(4, 1, {}, motion::KeypointSet::kCoco133);
  FitState state = initial_state(problem);
  for (int i = 0; i < kBetas; ++i) state.g[kFirstBeta + i] = i % 2 ? 1.5 : -1.0;
  const Character character = character_of(problem, state);
  const FrameKinematics k = kinematics(problem, state, character, 0);
  const std::vector<std::string> names = motion::keypoint_names(motion::KeypointSet::kCoco133);
  int feet = 0;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const FitPoint& point = problem.points[i];
    const auto place = motion::place_of_keypoint(names[point.column]);
    const Vector3d p_B = motion::place_on(character, *place);
    EXPECT_LT((point_of(problem, state, k, i) - k.poses.p_WB[point.body] - k.R[point.body] * p_B).norm(),
              1e-9)
        << names[point.column];
    if (place->last < 0) continue;
    ++feet;
    const bool heel = names[point.column].ends_with("heel");
    EXPECT_EQ(p_B.z() < 0.0, heel) << "heels are behind the ankle, toes before the ball";
  }
  EXPECT_EQ(feet, 6);
}

TEST(FitProblem, JitterIsTheWhitePartOfTheInput) {
  for (const double size : {0.005, 0.03}) {
    Random random(8, {1});
    motion::Clip clip = test::random_clip(8, 900, 0.15);
    for (int t = 0; t < clip.frames(); ++t) {
      for (int b = 1; b < kBodies; ++b) {
        const Vector3d error = size * (b == kLeftElbow ? 3.0 : 1.0) * test::random_vector(random);
        clip.rotations[t][b] = log_map(exp_map(clip.rotations[t][b]) * exp_map(error));
      }
      clip.trans[t] += size * test::random_vector(random);
    }
    const FitProblem problem = make_problem(clip, {});
    EXPECT_NEAR(problem.rotation_jitter, size, 0.05 * size);
    EXPECT_NEAR(problem.position_jitter, size, 0.1 * size);
    EXPECT_NEAR(problem.joint_jitter[kLeftElbow], 3.0 * size, 0.3 * size);
    EXPECT_NEAR(problem.joint_jitter[kRightKnee], size, 0.1 * size);
  }
  const FitProblem smooth = make_problem(test::random_clip(8, 900, 0.15), {});
  EXPECT_LT(smooth.rotation_jitter, 0.0005);
  EXPECT_LT(smooth.position_jitter, 0.0005);
}

TEST(FitProblem, ForeignBodyGetsTheSpreadOfPeople) {
  motion::Clip clip = test::random_clip(6, 4, 0.1);
  clip.body_model = "smplx";
  clip.keypoints.emplace();
  clip.keypoints->uvc.resize(4);
  clip.keypoints->extrinsics.assign(1, Eigen::Matrix4d::Identity());
  const FitConfig config;
  const FitProblem foreign = make_problem(clip, config);
  std::array<double, kBetas> tall{};
  tall[0] = foreign.beta_sigma[0];
  const Character one = make_character(), other = make_character(tall);
  for (int b = 1; b < kBodies; ++b)
    EXPECT_NEAR(other.joint_offset[b].norm() / one.joint_offset[b].norm(), 1.0 + config.stature_spread, 1e-9);
  std::array<double, kBetas> legs{};
  legs[2] = foreign.beta_sigma[2];
  EXPECT_NEAR(make_character(legs).joint_offset[kLeftKnee].y() / one.joint_offset[kLeftKnee].y(),
              1.0 + config.proportion_spread, 2e-3);
  clip.body_model = "mimicx";
  for (double sigma : make_problem(clip, config).beta_sigma) EXPECT_EQ(sigma, config.beta_sigma);
}

TEST(FitProblem, KnownRestJointsFixTheShape) {
  motion::Clip clip = test::random_clip(6, 4, 0.1);
  clip.body_model = "smplx";
  clip.keypoints.emplace();
  clip.keypoints->uvc.resize(4);
  clip.keypoints->extrinsics.assign(1, Eigen::Matrix4d::Identity());
  clip.rest_joints.emplace();
  const Character body = make_character();
  for (int b = 1; b < kBodies; ++b)
    (*clip.rest_joints)[b] = (*clip.rest_joints)[kParents[b]] + body.joint_offset[b];
  const FitProblem problem = make_problem(clip, FitConfig{});
  EXPECT_TRUE(problem.rest_joints);
  for (double sigma : problem.beta_sigma) EXPECT_EQ(sigma, 0.0);
}

}  // namespace
}  // namespace mimicx::fit
