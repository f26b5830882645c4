// Feedback gains of a finished plan: robustness that the plan alone does not have.
#include "control/gains.h"

#include <gtest/gtest.h>

#include "control/fixtures.h"
#include "control/plan.h"

namespace mimicx::control {
namespace {

/// A planned walk and its gains, made once for all tests.
struct Walk {
  System system = system_of(synthetic_reference("walk", 501, 90));
  Cost cost = make_cost(system, {});
  Trajectory motion = trajectory_of(make_plan(system, {}, {.threads = 2}));
  List<Eigen::MatrixXf> gains = feedback_gains(system, cost, motion, {}, {.threads = 2});
};
const Walk& planned_walk() {
  static const Walk walk;
  return walk;
}

TEST(Gains, KeepAWalkUprightUnderPushesThatToppleThePlan) {
  const Walk& walk = planned_walk();
  const auto& gains = walk.gains;
  ASSERT_EQ(gains.size(), 89u);
  EXPECT_EQ(gains[0].rows(), kDofs);
  EXPECT_EQ(gains[0].cols(), kMemory);
  EXPECT_GE(test_pushes(walk.system, walk.cost, walk.motion, gains, {}).followed, 14);
  const PushResult open = test_pushes(walk.system, walk.cost, walk.motion, {}, {});
  EXPECT_LE(open.followed, 8);
  EXPECT_LT(open.frames_kept, 89.0);
}

// The gains of planning itself use derivatives with the contacts of the planned state.
TEST(Gains, SoftenedGainsWithstandMoreThanStiffGains) {
  const Walk& walk = planned_walk();
  GainConfig stiff;
  stiff.smoothing = {};
  stiff.residual = walk.cost.weights.residual;
  stiff.change = walk.cost.weights.change;
  const auto followed = [&](const auto& gains) {
    return test_pushes(walk.system, walk.cost, walk.motion, gains, {.speed = 0.25}).followed;
  };
  EXPECT_GE(followed(walk.gains),
            followed(feedback_gains(walk.system, walk.cost, walk.motion, stiff, {.threads = 2})) + 3);
}

// Not to the byte: the laws respond to the rounding of x ⊖ x̄.
TEST(Gains, WithoutPushesThePlanIsFollowed) {
  const Walk& walk = planned_walk();
  const PushResult still = test_pushes(walk.system, walk.cost, walk.motion, walk.gains,
                                       {.speed = 0.0, .failure_distance = 1.01 * walk.motion.worst});
  EXPECT_EQ(still.followed, 16);
}

TEST(Gains, DoNotDependOnBlocksOrThreads) {
  Walk walk = planned_walk();
  walk.motion.x.resize(41);
  walk.motion.u.resize(40);
  GainConfig options;
  const auto whole = feedback_gains(walk.system, walk.cost, walk.motion, options, {.threads = 1});
  options.block = 7;
  const auto blocks = feedback_gains(walk.system, walk.cost, walk.motion, options, {.threads = 2});
  ASSERT_EQ(whole.size(), blocks.size());
  for (std::size_t t = 0; t < whole.size(); ++t) EXPECT_EQ(whole[t], blocks[t]) << t;
}

TEST(Gains, AreEmptyAfterAStop) {
  const Walk& walk = planned_walk();
  EXPECT_TRUE(
      feedback_gains(walk.system, walk.cost, walk.motion, {}, {.should_stop = [] { return true; }}).empty());
}

}  // namespace
}  // namespace mimicx::control
