#include "pipeline/training_log.h"

#include <gtest/gtest.h>

#include "core/named_values.h"
#include "report/glossary.h"

namespace mimicx::pipeline {
namespace {

TEST(TrainingLog, EveryValueIsInItsColumn) {
  TrainingLogRow row;
  row.iteration.iteration = 3;
  row.iteration.samples = 4096;
  row.iteration.mean_reward = 0.5;
  row.iteration.mean_episode_length = 17.0;
  row.iteration.kl = 0.01;
  row.iteration.step_size = 0.02;
  row.iteration.sigma = 0.03;
  row.iteration.policy_loss = 0.04;
  row.iteration.value_loss = 0.05;
  row.iteration.explained_variance = 0.06;
  row.iteration.clip_fraction = 0.07;
  row.iteration.actor_gradient = 0.08;
  row.iteration.critic_gradient = 0.09;
  row.iteration.penalty = 0.10;
  row.iteration.saturation = 0.11;
  row.tracking.steps = 10;
  for (std::size_t k = 0; k < rl::tracking::kRewardTerms; ++k)
    row.tracking.reward_terms[k] = static_cast<double>(k);
  row.tracking.saturated_joints = 2.0 * 10 * kJoints;
  row.sharpness = 0.12;
  row.rollout_reward = 0.13;
  row.rollout_position_error = 0.014;
  record::Table log = empty_training_log();
  append(log, row);
  ASSERT_EQ(log.rows.size(), 1u);
  ASSERT_EQ(log.rows[0].size(), log.columns.size());
  const NamedValues expected = {{"iteration", 3},
                                {"samples", 4096},
                                {"reward", 0.5},
                                {"episode_length", 17},
                                {"reward_term:root_position", 0.0},
                                {"reward_term:root_rotation", 0.1},
                                {"reward_term:pose", 0.2},
                                {"reward_term:velocity", 0.3},
                                {"reward_term:end_effector", 0.4},
                                {"reward_term:projection", 0.5},
                                {"kl", 0.01},
                                {"step_size", 0.02},
                                {"sigma", 0.03},
                                {"policy_loss", 0.04},
                                {"value_loss", 0.05},
                                {"explained_variance", 0.06},
                                {"clip_fraction", 0.07},
                                {"gradient_norm:actor", 0.08},
                                {"gradient_norm:critic", 0.09},
                                {"penalty", 0.10},
                                {"saturation:actions", 0.11},
                                {"saturation:torques", 2.0},
                                {"sharpness", 0.12},
                                {"rollout_reward", 0.13},
                                {"rollout_position_error_mm", 14.0}};
  ASSERT_EQ(log.columns.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(log.columns[k], expected[k].first);
    EXPECT_DOUBLE_EQ(log.rows[0][k], expected[k].second) << expected[k].first;
  }
}

TEST(TrainingLog, ReportHasWordsForEveryColumn) {
  for (const std::string& column : empty_training_log().columns)
    EXPECT_TRUE(report::has_words("log", column.substr(0, column.find(':')))) << column;
}

}  // namespace
}  // namespace mimicx::pipeline
