// What a teacher knows: the planned motion by itself, and what to do beside it.
#include "teaching/teacher.h"

#include <gtest/gtest.h>

#include "rl/tracking/tracking_fixture.h"
#include "rl/tracking/tracking_rollout.h"
#include "teaching/taught_motion.h"

namespace mimicx::teaching {
namespace {

using physics::kLanes;

/// Largest distance of any body between two motions, m.
double farthest(const PerFrame<BodyPoses>& a, const std::vector<rl::tracking::Pose>& b) {
  double worst = 0.0;
  for (int t = 0; t < a.count(); ++t)
    for (int i = 0; i < kBodies; ++i)
      worst = std::max(worst, (a[t].p_WB[i] - b[static_cast<std::size_t>(t)].p_WB[i]).norm());
  return worst;
}

TEST(Teacher, ControlsOnThePlannedStatesRepeatTheMotion) {
  const Teacher& teacher = teacher_of_squat();
  ASSERT_EQ(teacher.size(), 44);
  int t = 0;
  const auto rollout = rl::tracking::roll_out(teacher.clip, {}, [&](int, const float*, float* action) {
    std::copy_n(teacher.motion.u[t++].begin(), kDofs, action);
  });
  EXPECT_LT(farthest(teacher.clip->reference.poses, rollout.poses), 0.003);
  for (int i = 0; i < teacher.size(); ++i)  // and they are what the teacher believes, to the bit
    EXPECT_EQ(physics::to_eigen(teacher.motion.x[i].p_root),
              rollout.poses[static_cast<std::size_t>(i)].frame.p_root)
        << i;
}

TEST(Teacher, RepeatsAMotionOnAPlate) {
  const motion::Reference high = rl::tracking::on_a_plate(short_squat());
  const control::System system =
      control::make_system(high.character, {}, rl::tracking::simulator_states(high), high.fps, high.scene);
  const control::Plan plan = control::make_plan(system, {}, {.threads = 2});
  ASSERT_EQ(plan.ending, control::Ending::kFollowed);
  const std::optional<Teacher> teacher = make_teacher(high, plan, {}, {}, {.threads = 2});
  ASSERT_TRUE(teacher);
  int t = 0;
  const auto rollout = rl::tracking::roll_out(teacher->clip, {}, [&](int, const float*, float* action) {
    std::copy_n(teacher->motion.u[t++].begin(), kDofs, action);
  });
  EXPECT_LT(farthest(teacher->clip->reference.poses, rollout.poses), 0.003);
}

TEST(Teacher, TeachesThePlannedMotionNotTheReference) {
  const Teacher& teacher = teacher_of_squat();
  for (int t = 0; t < 45; ++t)
    EXPECT_EQ(teacher.clip->reference.frames[t].p_root, physics::to_eigen(plan_of_squat().states[t].p_root));
}

TEST(Teacher, ReplaysThePlanOnPlannedStates) {
  const Teacher& teacher = teacher_of_squat();
  const int t = 20;
  LaneActions before;
  for (int lane = 0; lane < kLanes; ++lane)
    std::copy_n(teacher.motion.u[t - 1].begin(), kDofs, before[lane].begin());
  const auto x = physics::in_all_lanes<control::P>(teacher.motion.x[t]);
  const LaneActions advice = ask(teacher, t, x, before);
  for (int k = 0; k < kDofs; ++k) EXPECT_NEAR(advice[0][k], teacher.motion.u[t][k], 1e-5) << k;
}

TEST(Teacher, AddsClampedFeedbackOffThePlan) {
  const Teacher& teacher = teacher_of_squat();
  const int t = 20;
  LaneActions before;
  for (int lane = 0; lane < kLanes; ++lane)
    std::copy_n(teacher.motion.u[t - 1].begin(), kDofs, before[lane].begin());
  physics::State<double> moved = teacher.motion.x[t];
  moved.v_root.x += 0.25;  // a number that floats hold
  auto x = physics::in_all_lanes<control::P>(teacher.motion.x[t]);
  physics::set_lane(x, 1, moved);
  moved.v_root.x += 1e6;
  physics::set_lane(x, 2, moved);
  const LaneActions advice = ask(teacher, t, x, before);
  for (int k = 0; k < kDofs; ++k) {
    const float expected = 0.25f * teacher.gains[t](k, control::kRootVelocity);
    EXPECT_NEAR(advice[1][k] - advice[0][k], expected, 1e-4f) << k;
    EXPECT_LE(std::abs(advice[2][k] - teacher.motion.u[t][k]), 1.0f + 1e-5f) << k;
  }
}

TEST(Teacher, ImportanceIsSymmetricPositiveWithUnitMeanDiagonal) {
  const Teacher& teacher = teacher_of_squat();
  double sum = 0.0;
  for (const Eigen::MatrixXf& W : teacher.importance) {
    EXPECT_EQ(W, W.transpose());
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXf>(W).info(), Eigen::Success);
    sum += static_cast<double>(W.trace()) / kDofs;
  }
  EXPECT_NEAR(sum / teacher.size(), 1.0, 1e-5);
}

TEST(Teacher, PlanThatCannotBeRepeatedGivesNoTeacher) {
  TeacherConfig impatient;
  impatient.horizon.failure_distance = 1e-9;
  impatient.horizon.backtracks = 0;
  EXPECT_FALSE(make_teacher(short_squat(), plan_of_squat(), impatient, {}, {}));
}

TEST(Teacher, StopsOnRequest) {
  control::PlanControl control;
  control.should_stop = [] { return true; };
  EXPECT_FALSE(make_teacher(short_squat(), plan_of_squat(), {}, {}, control));
}

}  // namespace
}  // namespace mimicx::teaching
