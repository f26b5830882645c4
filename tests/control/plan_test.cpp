// Whole plans: followed, replayed, independent of threads; infeasible references are reported.
#include "control/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "control/fixtures.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::control {
namespace {

/// Mean distance of all joints in the world, frames 1 …, m.
double mean_distance(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout) {
  double sum = 0.0;
  for (std::size_t t = 1; t < rollout.poses.size(); ++t)
    for (std::size_t i = 0; i < kBodies; ++i)
      sum += (rollout.poses[t].p_WB[i] - reference.poses[t].p_WB[i]).norm();
  return sum / static_cast<double>(kBodies * (rollout.poses.size() - 1));
}

rl::tracking::TrackingRollout replay(const motion::Reference& reference, const Plan& plan) {
  const rl::tracking::TrackingConfig config;
  std::size_t t = 0;
  return rl::tracking::roll_out(rl::tracking::make_tracking_clip(reference, config), config,
                                [&](int, const float*, float* action) {
                                  std::copy(plan.residuals[t].begin(), plan.residuals[t].end(), action);
                                  ++t;
                                });
}

class Followed : public testing::TestWithParam<const char*> {};

TEST_P(Followed, WithinTwoMillimetresAndReplayedByteForByte) {
  const motion::Reference reference = synthetic_reference(GetParam(), 501, 75);
  const Plan plan = make_plan(system_of(reference), {}, {.threads = 2});
  EXPECT_EQ(plan.ending, Ending::kFollowed);
  EXPECT_FALSE(plan.failure);
  EXPECT_TRUE(plan.stage_assistance.empty());
  ASSERT_EQ(plan.states.size(), 75u);
  const rl::tracking::TrackingRollout rollout = replay(reference, plan);
  ASSERT_EQ(rollout.poses.size(), 75u);
  EXPECT_LT(mean_distance(reference, rollout), 0.002);
  for (std::size_t t = 1; t < 75; ++t) {
    EXPECT_EQ(to_eigen(plan.states[t].p_root), rollout.poses[t].frame.p_root) << t;
    for (std::size_t i = 0; i < kBodies; ++i) {
      EXPECT_EQ(to_eigen(plan.states[t].q[i]).normalized().coeffs(), rollout.poses[t].frame.q[i].coeffs());
      EXPECT_EQ(to_eigen(plan.states[t].omega[i]), rollout.poses[t].frame.omega[i]);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Motions, Followed, testing::Values("squat", "walk"));

TEST(Plan, OneAndTwoThreadsGiveTheSameBytes) {
  const System system = system_of(synthetic_reference("jump", 501, 30));
  const Plan one = make_plan(system, {}, {.threads = 1}), two = make_plan(system, {}, {.threads = 2});
  EXPECT_EQ(one.residuals, two.residuals);
  EXPECT_EQ(one.cost, two.cost);
  ASSERT_EQ(one.states.size(), two.states.size());
  EXPECT_EQ(std::memcmp(one.states.data(), two.states.data(), one.states.size() * sizeof one.states[0]), 0);
}

/// A reference that stands and rises into the air from frame 10 on, at 2 m/s².
System balloon() {
  System system = system_of(synthetic_reference("stand", 501, 46));
  for (std::size_t t = 10; t < 46; ++t) {
    const double time = static_cast<double>(t - 10) / 30.0;
    system.reference[t].p_root.z += time * time;
    system.reference[t].v_root.z += 2.0 * time;
  }
  return system;
}

/// Settings under which a plan that fails does so soon.
PlanConfig lost_soon() {
  PlanConfig config;
  config.horizon.backtracks = 1;
  return config;
}

TEST(Plan, ReportsAnInfeasibleReferenceAndTheForcesItNeeds) {
  const System system = balloon();
  PlanConfig config = lost_soon();
  config.horizon.budget = 4;
  const Plan plan = make_plan(system, config, {.threads = 2});
  EXPECT_EQ(plan.ending, Ending::kLost);
  ASSERT_TRUE(plan.failure);
  EXPECT_GT(plan.failure->frame, 10);
  EXPECT_LT(plan.failure->frame, 35);
  EXPECT_GE(plan.failure->body, 0);
  EXPECT_GT(plan.failure->distance, 0.05);
  // In the air the assistive force is about the weight; standing needs none.
  const double weight = 9.81 * system.mass;
  const List<Vector6d> assistance = wrenches_of(plan.stage_assistance, system.mass);
  ASSERT_EQ(assistance.size(), 45u);
  EXPECT_GT(assistance[plan.failure->frame].tail<3>().norm(), 0.8 * weight);
  EXPECT_LT(assistance[plan.failure->frame].tail<3>().norm(), 3.0 * weight);
  EXPECT_LT(assistance[5].tail<3>().norm(), 0.1 * weight);
  EXPECT_FALSE(plan.by_assisted_stages);
  EXPECT_GT(plan.states.size(), 10u);
  EXPECT_LT(plan.states.size(), 46u);
  EXPECT_EQ(plan.residuals.size() + 1, plan.states.size());
}

TEST(Plan, EndsWithWindowsShorterThanTheShortestVariant) {
  PlanConfig config = lost_soon();
  config.horizon.backtracks = 12;
  config.horizon.horizon = 4;
  config.horizon.failure_distance = 1e-6;
  config.assisted_stages = false;
  EXPECT_EQ(make_plan(balloon(), config, {.threads = 2}).ending, Ending::kLost);
}

/// A reference that stands, is lifted by `kHeight` and put down within 0.8 s: a jump without a crouch.
constexpr double kHeight = 0.5;
System lifted() {
  constexpr int kFirst = 10, kFrames = 24;
  System system = system_of(synthetic_reference("stand", 501, 40));
  for (int t = 0; t < kFrames; ++t) {
    const double angle = 2.0 * std::numbers::pi * t / kFrames;
    auto& frame = system.reference[kFirst + t];
    frame.p_root.z += 0.5 * kHeight * (1.0 - std::cos(angle));
    frame.v_root.z += std::numbers::pi * kHeight * std::sin(angle);
  }
  return system;
}

/// A stage that is lost continues with the root of its factor, as if planning had started with that one.
/// Which of these factors is too large depends on the last bits of the simulation.
TEST(Plan, FailedStageIsRetriedWithSmallerCostIncreases) {
  bool retried = false;
  for (const double factor : {1e6, 1e4, 1e8, 1e3, 1e12, 1e5, 1e7}) {
    PlanConfig config = lost_soon();
    config.stiffening = std::sqrt(factor);
    const Plan by_root = make_plan(lifted(), config, {.threads = 2});
    config.stiffening = factor;
    const Plan plan = make_plan(lifted(), config, {.threads = 2});
    if (plan.residuals != by_root.residuals) continue;  // no stage was lost
    retried = true;
    EXPECT_GT(plan.linearised, by_root.linearised) << "the stage that was lost";
    EXPECT_EQ(plan.ending, Ending::kFollowed);
    EXPECT_TRUE(plan.by_assisted_stages);
    EXPECT_FALSE(plan.failure);
    EXPECT_EQ(plan.states.size(), 40u);
    EXPECT_LT(plan.worst_distance, kHeight) << "as far is a body that does not leave the floor";
    break;
  }
  EXPECT_TRUE(retried);
}

// The assistive acceleration is that of the reference plus gravity.
TEST(Plan, AssistedPlanFollowsAnInfeasibleReference) {
  System system = balloon();
  system.assisted = true;
  const Plan plan = make_plan(system, {}, {.threads = 2});
  EXPECT_EQ(plan.ending, Ending::kFollowed);
  ASSERT_EQ(plan.assistance.size(), 45u);
  EXPECT_LT(plan.worst_distance, 0.35);
  EXPECT_NEAR(static_cast<double>(plan.assistance[35][2]), 11.81, 1.0);
  EXPECT_LT(std::abs(static_cast<double>(plan.assistance[5][2])), 1.0);
}

TEST(Plan, StopsOnRequest) {
  const System system = system_of(synthetic_reference("stand", 501, 60));
  int windows = 0, settled = 0;
  const Plan plan = make_plan(system, {},
                              {.threads = 2,
                               .should_stop = [&] { return ++windows > 2; },
                               .progress =
                                   [&](int done, int frames) {
                                     EXPECT_EQ(frames, 60);
                                     EXPECT_GT(done, settled);
                                     settled = done;
                                   }});
  EXPECT_EQ(plan.ending, Ending::kStopped);
  EXPECT_EQ(static_cast<int>(plan.states.size()), settled + 1);
}

// Assisted stages and the gentle attempt that follow a failure start anew.
TEST(Plan, MoreTimeGivesNoShorterPlan) {
  const System system = balloon();
  PlanConfig config = lost_soon();
  config.horizon.budget = 4;
  int windows = 0;
  const std::size_t whole =
      make_plan(system, config, {.threads = 2, .should_stop = [&] { return ++windows < 0; }}).states.size();
  std::size_t longest = 0;
  for (int k = 1; k < 8; ++k) {
    int asked = 0;
    const Plan plan =
        make_plan(system, config, {.threads = 2, .should_stop = [&] { return ++asked > windows * k / 8; }});
    EXPECT_EQ(plan.ending, Ending::kStopped) << k;
    EXPECT_GE(plan.states.size(), longest) << k;
    EXPECT_EQ(plan.residuals.size() + 1, plan.states.size()) << k;
    longest = plan.states.size();
  }
  EXPECT_LE(longest, whole);
  EXPECT_GT(longest, 10u);
}

}  // namespace
}  // namespace mimicx::control
