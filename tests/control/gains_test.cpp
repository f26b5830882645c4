// Feedback gains of a finished plan: robustness that the plan alone does not have.
#include "control/gains.h"

#include <gtest/gtest.h>

#include "control/fixtures.h"
#include "control/plan.h"

namespace mimicx::control {
namespace {

struct Walk {
  System system = system_of(synthetic_reference("walk", 501, 90));
  Cost cost = make_cost(system, {});
  Trajectory motion = trajectory_of(make_plan(system, {}, {.threads = 2}));
};

TEST(Gains, KeepAWalkUprightUnderPushesThatToppleThePlan) {
  const Walk walk;
  const auto gains = feedback_gains(walk.system, walk.cost, walk.motion, {}, {.threads = 2});
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
  const Walk walk;
  GainConfig stiff;
  stiff.smoothing = {};
  stiff.residual = walk.cost.weights.residual;
  stiff.change = walk.cost.weights.change;
  const auto followed = [&](const GainConfig& config) {
    const auto gains = feedback_gains(walk.system, walk.cost, walk.motion, config, {.threads = 2});
    return test_pushes(walk.system, walk.cost, walk.motion, gains, {.speed = 0.25}).followed;
  };
  EXPECT_GE(followed({}), followed(stiff) + 3);
}

// Not to the byte: the laws respond to the rounding of x ⊖ x̄.
TEST(Gains, WithoutPushesThePlanIsFollowed) {
  const Walk walk;
  const auto gains = feedback_gains(walk.system, walk.cost, walk.motion, {}, {.threads = 2});
  const PushResult still = test_pushes(walk.system, walk.cost, walk.motion, gains,
                                       {.speed = 0.0, .failure_distance = 1.01 * walk.motion.worst});
  EXPECT_EQ(still.followed, 16);
}

TEST(Gains, DoNotDependOnBlocksOrThreads) {
  Walk walk;
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
  const Walk walk;
  EXPECT_TRUE(
      feedback_gains(walk.system, walk.cost, walk.motion, {}, {.should_stop = [] { return true; }}).empty());
}

}  // namespace
}  // namespace mimicx::control
