#include "rl/rollout.h"

#include <gtest/gtest.h>

#include "rl/ppo_fixture.h"

namespace mimicx::rl {
namespace {

TEST(Rollout, BootstrapsTruncatedEpisodesFromTheirOwnFinalObservation) {
  const Agent agent = small_agent();
  RolloutBuffer buffer = make_rollout_buffer(1, 3, 1, 2, 1);
  GroupRollout& group = buffer.groups.front();
  CollectScratch scratch(3, 2);
  Random random(1);
  begin_rollout(group);
  scratch.raw.setConstant(0.1F);
  record_decision({&agent}, 0.1, 0, random, scratch, group);
  scratch.result.reward.setConstant(1.0F);
  scratch.result.truncated[1] = true;
  scratch.result.terminated[2] = true;
  scratch.result.final_observations.setConstant(0.7F);
  record_result({&agent}, 0, scratch, group);
  scratch.raw.setConstant(-0.4F);
  finish_rollout({&agent}, {0.9, 0.95}, scratch, group);

  nn::Workspace<float> workspace;
  const auto value = [&](float x) {
    nn::Matrix<float> in = nn::Matrix<float>::Constant(1, 2, x), out;
    nn::evaluate(agent.critic, in, workspace, out);
    return out(0, 0);
  };
  EXPECT_NEAR(group.advantages(0, 0), 1.0F + 0.9F * value(-0.4F) - value(0.1F), 1e-5);
  EXPECT_NEAR(group.advantages(0, 1), 1.0F + 0.9F * value(0.7F) - value(0.1F), 1e-5);
  EXPECT_NEAR(group.advantages(0, 2), 1.0F - value(0.1F), 1e-5);
  EXPECT_EQ(group.ended_episodes, 2);
  EXPECT_EQ(group.ended_steps, 2);
}

}  // namespace
}  // namespace mimicx::rl
