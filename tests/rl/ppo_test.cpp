#include "rl/ppo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rl/ppo_fixture.h"

namespace mimicx::rl {
namespace {

constexpr ShuffleKey kShuffles = {.seed = 1, .learner = 0};

/// A roll-out of random numbers, as if an untrained agent had acted.
RolloutBuffer random_rollout(const Agent& agent, std::uint64_t seed) {
  RolloutBuffer buffer = make_rollout_buffer(2, 20, 10, 2, 1);
  CollectScratch scratch(20, 2);
  Random random(seed);
  for (GroupRollout& group : buffer.groups) {
    begin_rollout(group);
    for (int t = 0; t < 10; ++t) {
      for (Eigen::Index k = 0; k < scratch.raw.size(); ++k)
        scratch.raw.data()[k] = static_cast<float>(random.normal());
      record_decision({&agent}, 0.3, t, random, scratch, group);
      for (int i = 0; i < 20; ++i) {
        scratch.result.reward[i] = static_cast<float>(random.normal());
        scratch.result.terminated[i] = random.uniform() < 0.1;
        scratch.result.truncated[i] = random.uniform() < 0.1;
        scratch.result.final_observations.row(i).setConstant(static_cast<float>(random.normal()));
      }
      record_result({&agent}, t, scratch, group);
    }
    finish_rollout({&agent}, {0.97, 0.95}, scratch, group);
  }
  return buffer;
}

std::vector<int> rows_from(int begin, int end) {
  std::vector<int> rows;
  for (int row = begin; row < end; ++row) rows.push_back(row);
  return rows;
}

TEST(Ppo, UpdateReadsOnlyTheRowsItIsGiven) {
  const PpoConfig config = small_config();
  RolloutBuffer buffer = random_rollout(small_agent(), 3);
  const std::vector<int> mine = rows_from(0, 250);
  UpdateWorkers workers(config);
  IterationStats stats;
  Learner a = make_learner(config, small_agent()), b = a;
  update(a, config, {buffer, mine, 0.3}, kShuffles, workers, stats);
  GroupRollout& second = buffer.groups[1];  // rows 200 … 399
  second.observations.bottomRows(150).setConstant(1e6F);
  second.actions.bottomRows(150).setConstant(-1e6F);
  second.advantages.bottomRows(7).setConstant(1e6F);
  update(b, config, {buffer, mine, 0.3}, kShuffles, workers, stats);
  Npz first_state, second_state;
  save(first_state, "", a);
  save(second_state, "", b);
  expect_same_bytes(first_state, second_state);
}

// Advantages are of random numbers, so nothing but the penalty asks for a flatter actor.
TEST(Ppo, PenaltyWeightFlattensTheActor) {
  Agent steep = small_agent();
  *nn::parameters(steep.actor).end()[-2] *= 100.0F;  // untrained actors are nearly constant
  const RolloutBuffer buffer = random_rollout(steep, 5);
  const std::vector<int> rows = rows_from(0, buffer.rows());
  const auto steepness = [&](double weight) {
    PpoConfig config = small_config();
    config.epochs = 20;
    config.step_size = 5e-3;
    config.kl_stop = 1e9;
    config.gradient_norm = 1e9;
    config.penalty_weight = weight;
    UpdateWorkers workers(config);
    IterationStats stats;
    Learner learner = make_learner(config, steep);
    update(learner, config, {buffer, rows, 0.3}, kShuffles, workers, stats);
    nn::Workspace<float> workspace;
    nn::Matrix<float> left, right, at = nn::Matrix<float>::Zero(2, 2);
    at << -1.0F, -1.0F, -1.0F, 1.0F;
    nn::evaluate(learner.agent.actor, at, workspace, left);
    at.col(0).setConstant(1.0F);
    nn::evaluate(learner.agent.actor, at, workspace, right);
    return double{(right - left).norm()};
  };
  EXPECT_LT(steepness(10.0), 0.5 * steepness(0.0));
}

TEST(Ppo, SlotsAndPassesChangeTheGradientByRoundingOnly) {
  const RolloutBuffer buffer = random_rollout(small_agent(), 4);
  const std::vector<int> rows = rows_from(0, buffer.rows());
  std::vector<double> norms;
  for (const int slots : {1, 4})
    for (const int pass : {1000, 33}) {
      PpoConfig config = small_config();
      config.epochs = 1;
      config.penalty_fraction = 1.0;  // a sampled penalty depends on the cut
      config.minibatch = buffer.rows();
      config.gradient_slots = slots;
      config.pass_rows = pass;
      UpdateWorkers workers(config);
      IterationStats stats;
      Learner learner = make_learner(config, small_agent());
      update(learner, config, {buffer, rows, 0.3}, kShuffles, workers, stats);
      EXPECT_EQ(stats.minibatches, 1);
      norms.push_back(stats.actor_gradient);
      norms.push_back(stats.critic_gradient);
    }
  for (std::size_t k = 2; k < norms.size(); ++k) EXPECT_NEAR(norms[k] / norms[k % 2], 1.0, 1e-4);
}

TEST(Ppo, FirstMinibatchSeesNoDifferenceFromTheOldPolicy) {
  PpoConfig config = small_config();
  config.epochs = 1;
  config.minibatch = 400;
  const RolloutBuffer buffer = random_rollout(small_agent(), 6);
  UpdateWorkers workers(config);
  IterationStats stats;
  Learner learner = make_learner(config, small_agent());
  update(learner, config, {buffer, rows_from(0, 400), 0.3}, kShuffles, workers, stats);
  EXPECT_LT(stats.kl, 1e-9);
  EXPECT_EQ(stats.clip_fraction, 0.0);
  EXPECT_NEAR(stats.policy_loss, 0.0, 1e-5);  // normalised advantages sum to nothing
  EXPECT_EQ(learner.step_size, config.step_size) << "one step cannot see its own KL";
}

TEST(Ppo, ReportedKlIsThatOfThePolicyBeforeTheLastStep) {
  const double sigma = 0.3;
  PpoConfig config = small_config();
  config.minibatch = 400;
  config.kl_stop = 1e9;
  config.step_size = 3e-3;
  const RolloutBuffer buffer = random_rollout(small_agent(), 8);
  UpdateWorkers workers(config);
  IterationStats two_steps, one_step;
  Learner after_two = make_learner(config, small_agent()), after_one = after_two;
  update(after_two, config, {buffer, rows_from(0, 400), sigma}, kShuffles, workers, two_steps);
  config.epochs = 1;
  update(after_one, config, {buffer, rows_from(0, 400), sigma}, kShuffles, workers, one_step);
  double kl = 0.0;
  nn::Workspace<float> workspace;
  nn::Matrix<float> means;
  for (const GroupRollout& group : buffer.groups) {
    nn::evaluate(after_one.agent.actor, group.observations, workspace, means);
    kl += (means - group.means).cast<double>().squaredNorm() / (2.0 * sigma * sigma) / 400.0;
  }
  EXPECT_GT(kl, 1e-5);
  EXPECT_NEAR(two_steps.kl / kl, 1.0, 1e-3);
}

TEST(Ppo, StopsAnIterationOfLargeKl) {
  PpoConfig config = small_config();
  config.minibatch = 100;
  config.step_size = 0.05;
  const RolloutBuffer buffer = random_rollout(small_agent(), 7);
  UpdateWorkers workers(config);
  IterationStats stats;
  Learner learner = make_learner(config, small_agent());
  learner.step_size = 0.05;
  update(learner, config, {buffer, rows_from(0, 400), 0.3}, kShuffles, workers, stats);
  EXPECT_LT(stats.minibatches, 8);
  EXPECT_GT(stats.kl, config.kl_stop * config.kl_target);
}

TEST(StepSize, MovesByTheFactorOutsideTheBandAndStaysInItsBounds) {
  PpoConfig config = ppo_for_tests();
  config.kl_target = 0.02;
  const double step = 1e-4;
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.009), 1.5e-4);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.011), step);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.039), step);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.041), step / 1.5);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, config.step_min, 1.0), config.step_min);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, config.step_max, 0.0), config.step_max);
}

TEST(Sigma, FallsLinearlyAndThenStaysConstant) {
  const PpoConfig config = ppo_for_tests();
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 1000, 0), 0.07);
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 1000, 500), 0.055);
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 1000, 5000), 0.04);
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 0, 0), 0.04);
}

}  // namespace
}  // namespace mimicx::rl
