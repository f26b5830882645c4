#include "rl/ppo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rl/toy_environments.h"
#include "rl/trainer.h"

namespace mimicx::rl {
namespace {

using toy::DoubleIntegrator;
using toy::ToyEnvironment;
using Trainer = PpoTrainer<ToyEnvironment<DoubleIntegrator>>;

PpoConfig small_config() {
  PpoConfig config;
  config.horizon = 16;
  config.minibatch = 256;
  config.gradient_slots = 3;
  config.pass_rows = 50;  // several passes in a slot, of unequal size
  config.sigma_start = config.sigma_end = 0.3;
  config.penalty_weight = 0.01;
  config.penalty_fraction = 0.25;
  config.bound_weight = 0.1;
  config.mean_bound = 0.05;
  return config;
}

Agent small_agent(int observations = 2, int actions = 1) {
  AgentShape shape;
  shape.observation_dim = observations;
  shape.action_dim = actions;
  shape.hidden = {32, 16};
  return make_agent(shape, 5);
}

Npz state_of(const Trainer& trainer) {
  Npz archive;
  trainer.save(archive, "t.");
  return archive;
}

void expect_same_bytes(const Npz& a, const Npz& b) {
  ASSERT_EQ(a.members().size(), b.members().size());
  for (std::size_t k = 0; k < a.members().size(); ++k) {
    EXPECT_EQ(a.members()[k].first, b.members()[k].first);
    EXPECT_TRUE(a.members()[k].second.bytes == b.members()[k].second.bytes) << a.members()[k].first;
    EXPECT_TRUE(a.members()[k].second.text == b.members()[k].second.text) << a.members()[k].first;
  }
}

TEST(Ppo, IsBitIdenticalForOneAndTwoThreads) {
  ToyEnvironment<DoubleIntegrator> one(5, 12, 1), two(5, 12, 1);
  Trainer first(small_config(), small_agent(), one), second(small_config(), small_agent(), two);
  for (int k = 0; k < 6; ++k) {
    const IterationStats a = first.iterate(1), b = second.iterate(2);
    EXPECT_EQ(a.kl, b.kl);
    EXPECT_EQ(a.mean_reward, b.mean_reward);
    EXPECT_EQ(a.learned, k > 0);
  }
  expect_same_bytes(state_of(first), state_of(second));
}

TEST(Ppo, ResumingGivesTheBytesOfNeverHavingStopped) {
  ToyEnvironment<DoubleIntegrator> whole_world(4, 16, 2), first_world(4, 16, 2), second_world(4, 16, 99);
  Trainer whole(small_config(), small_agent(), whole_world);
  Trainer first(small_config(), small_agent(), first_world);
  for (int k = 0; k < 3; ++k) {
    whole.iterate(2);
    first.iterate(2);
  }
  PpoConfig other = small_config();
  other.step_size *= 7.0;  // the step size comes from the checkpoint
  Trainer resumed(other, small_agent(), second_world);
  // The world's own random numbers are keyed by its seed, which is configuration.
  second_world = ToyEnvironment<DoubleIntegrator>(4, 16, 2);
  resumed.load(state_of(first), "t.");
  for (int k = 0; k < 4; ++k) {
    const IterationStats expected = whole.iterate(2), found = resumed.iterate(2);
    EXPECT_EQ(found.mean_episode_length, expected.mean_episode_length);
    EXPECT_EQ(found.samples, expected.samples);
    EXPECT_EQ(found.kl, expected.kl);
  }
  expect_same_bytes(state_of(whole), state_of(resumed));
}

TEST(Ppo, LoadRefusesAnotherNumberOfCharacters) {
  ToyEnvironment<DoubleIntegrator> small(2, 8, 1), large(3, 8, 1);
  Trainer a(small_config(), small_agent(), small), b(small_config(), small_agent(), large);
  EXPECT_THROW(b.load(state_of(a), "t."), DataError);
}

TEST(Ppo, NoiseNeverRepeatsBetweenGroupsIterationsAndSeeds) {
  const auto noise = [](const Trainer& trainer, std::size_t group) {
    const GroupRollout& g = trainer.buffer().groups[group];
    return nn::Matrix<float>(g.actions - g.means);
  };
  ToyEnvironment<DoubleIntegrator> world(2, 8, 1), other_world(2, 8, 1);
  PpoConfig other_seed = small_config();
  ++other_seed.seed;
  Trainer trainer(small_config(), small_agent(), world), other(other_seed, small_agent(), other_world);
  trainer.iterate(1);
  other.iterate(1);
  const nn::Matrix<float> first = noise(trainer, 0), beside = noise(trainer, 1), elsewhere = noise(other, 0);
  trainer.iterate(1);
  for (const nn::Matrix<float>& m : {beside, elsewhere, noise(trainer, 0)})
    EXPECT_GT((m - first).cwiseAbs().minCoeff(), 0.0F);
}

TEST(Ppo, RollOutLeavesTheScaleOfItsObservationsBehind) {
  ToyEnvironment<DoubleIntegrator> world(2, 8, 1);
  Trainer trainer(small_config(), small_agent(), world);
  for (int k = 0; k < 3; ++k) trainer.iterate(2);
  EXPECT_EQ(trainer.learner().agent.observations.moments.count, 3 * trainer.buffer().rows());
  EXPECT_EQ(trainer.learner().samples, 3 * trainer.buffer().rows());
}

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
    finish_rollout({&agent}, 0.97, 0.95, scratch, group);
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
  UpdateScratch scratch(config);
  IterationStats stats;
  Learner a = make_learner(config, small_agent()), b = a;
  update(a, config, buffer, mine, 0.3, 0, 1, scratch, stats);
  GroupRollout& second = buffer.groups[1];  // rows 200 … 399
  second.observations.bottomRows(150).setConstant(1e6F);
  second.actions.bottomRows(150).setConstant(-1e6F);
  second.advantages.bottomRows(7).setConstant(1e6F);
  update(b, config, buffer, mine, 0.3, 0, 1, scratch, stats);
  Npz first_state, second_state;
  save(first_state, "", a);
  save(second_state, "", b);
  expect_same_bytes(first_state, second_state);
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
      UpdateScratch scratch(config);
      IterationStats stats;
      Learner learner = make_learner(config, small_agent());
      update(learner, config, buffer, rows, 0.3, 0, 1, scratch, stats);
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
  UpdateScratch scratch(config);
  IterationStats stats;
  Learner learner = make_learner(config, small_agent());
  update(learner, config, buffer, rows_from(0, 400), 0.3, 0, 1, scratch, stats);
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
  UpdateScratch scratch(config);
  IterationStats two_steps, one_step;
  Learner after_two = make_learner(config, small_agent()), after_one = after_two;
  update(after_two, config, buffer, rows_from(0, 400), sigma, 0, 1, scratch, two_steps);
  config.epochs = 1;
  update(after_one, config, buffer, rows_from(0, 400), sigma, 0, 1, scratch, one_step);
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

TEST(Ppo, StopsAnIterationThatRunsAway) {
  PpoConfig config = small_config();
  config.minibatch = 100;
  config.step_size = 0.05;
  const RolloutBuffer buffer = random_rollout(small_agent(), 7);
  UpdateScratch scratch(config);
  IterationStats stats;
  Learner learner = make_learner(config, small_agent());
  learner.step_size = 0.05;
  update(learner, config, buffer, rows_from(0, 400), 0.3, 0, 1, scratch, stats);
  EXPECT_LT(stats.minibatches, 8);
  EXPECT_GT(stats.kl, config.kl_stop * config.kl_target);
}

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
  finish_rollout({&agent}, 0.9, 0.95, scratch, group);

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

TEST(StepSize, MovesByTheFactorOutsideTheBandAndStaysInItsBounds) {
  PpoConfig config;
  config.kl_target = 0.02;
  const double step = 1e-4;
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.009), 1.5e-4);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.011), step);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.039), step);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, step, 0.041), step / 1.5);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, config.step_min, 1.0), config.step_min);
  EXPECT_DOUBLE_EQ(adapted_step_size(config, config.step_max, 0.0), config.step_max);
}

TEST(Sigma, FallsLinearlyAndStays) {
  PpoConfig config;
  config.sigma_samples = 1000;
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 0), 0.07);
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 500), 0.055);
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 5000), 0.04);
  config.sigma_samples = 0;
  EXPECT_DOUBLE_EQ(exploration_sigma(config, 0), 0.04);
}

}  // namespace
}  // namespace mimicx::rl
