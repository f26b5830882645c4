#include "pipeline/training_loop.h"

#include <gtest/gtest.h>

#include "core/temporary_folder.h"
#include "program/small_run.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::pipeline {
namespace {

struct Training : testing::Test {
  /// Trains an agent that first does `action` in every state.
  TrainingResult train_from(float action) const {
    const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(60), config.tracking);
    const TrainingFiles files = {folder.path / "agent.npz", folder.path / "log.csv",
                                 folder.path / "falls.csv", "sway"};
    TrainingControl control;
    control.should_stop = [] { return false; };
    control.progress = [](std::int64_t, const std::string&) {};
    return train({clip}, {rl::tracking::agent_that_does(action)}, config, files, control);
  }

  TrainingConfig config = program::small_training();
  TemporaryFolder folder;
};

TEST_F(Training, RewardEndsItIfTheMotionIsFollowed) {
  config.stop_reward = 1e-9;
  EXPECT_EQ(train_from(0.0F).ending, record::SequenceEnding::kThreshold);
}

TEST_F(Training, RewardOfARollOutThatLostTheMotionDoesNotEndIt) {
  config.stop_reward = 1e-9;
  EXPECT_EQ(train_from(1.5F).ending, record::SequenceEnding::kBudget);
}

TEST_F(Training, LogHasTheSharpnessOfEachIterationsRewards) {
  train_from(1.5F);
  const record::Table log = record::read_csv(folder.path / "log.csv");
  const std::size_t sharpness = log.column("sharpness");
  EXPECT_EQ(log.rows[0][sharpness], 1.0) << "no roll-out has softened it yet";
  EXPECT_LT(log.rows[1][sharpness], 1.0);
}

TEST(Stall, CountsFollowingRollOutsWithoutImprovement) {
  EXPECT_EQ(stall_age(3, 0.020, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.025, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.015, 0.020), 0) << "markedly better";
  EXPECT_EQ(stall_age(3, 0.700, 0.020), 0) << "it falls again: an earlier roll-out was lucky";
  EXPECT_EQ(stall_age(3, 0.700, 0.900), 0) << "not followed yet";
}

}  // namespace
}  // namespace mimicx::pipeline
