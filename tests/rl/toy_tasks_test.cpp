/// PPO on tasks with known solutions. Seeds are fixed, so the results are reproducible.
#include <gtest/gtest.h>

#include <cmath>

#include "rl/ppo_fixture.h"
#include "rl/toy_environments.h"
#include "rl/trainer.h"

namespace mimicx::rl {
namespace {

using namespace toy;

constexpr int kThreads = 1;
constexpr Course kToyCourse = {.seed = 1, .falling_samples = 2'000'000};

Agent agent_for(int observations, int actions, std::uint64_t seed) {
  AgentShape shape;
  shape.observation_dim = observations;
  shape.action_dim = actions;
  shape.hidden = {32, 32};
  return make_agent(shape, seed);
}

PpoConfig toy_config() {
  PpoConfig config = ppo_for_tests();
  config.minibatch = 1024;
  config.step_max = 1e-2;
  config.critic_step_size = 1e-3;
  return config;
}

/// Gain K of u = −K·x that minimises Σ γᵗ(xᵀQx + R u²): the discounted Riccati equation, iterated. Noise that
/// is added to u does not change it.
Eigen::RowVector2d riccati_gain(double gamma) {
  using Task = toy::DoubleIntegrator;
  const Eigen::Matrix2d a = (Eigen::Matrix2d() << 1.0, Task::kDt, 0.0, 1.0).finished();
  const Eigen::Vector2d b(0.0, Task::kDt);
  const Eigen::Matrix2d q = Eigen::Vector2d(Task::kPositionCost, Task::kVelocityCost).asDiagonal();
  Eigen::Matrix2d p = q;
  Eigen::RowVector2d gain;
  for (int k = 0; k < 2000; ++k) {
    gain = gamma * (b.transpose() * p * a) / (Task::kForceCost + gamma * b.dot(p * b));
    p = q + gamma * a.transpose() * p * (a - b * gain);
  }
  return gain;
}

/// μ(x) = −K·x + μ(0) of a linear actor behind its normaliser: (K, μ(0)).
Eigen::RowVector3d linear_law(const Agent& agent) {
  const Eigen::RowVector2d gain =
      -(agent.actor.weights[0].col(0).transpose().array() * agent.observations.factor.row(0).array())
           .cast<double>()
           .matrix();
  const double at_zero = agent.actor.biases[0](0) + gain.dot(agent.observations.shift.row(0).cast<double>());
  return {gain[0], gain[1], at_zero};
}

TEST(ToyTasks, LinearPolicyFindsTheRiccatiGain) {
  toy::ToyEnvironment<toy::DoubleIntegrator> world(4, 64, 1);
  PpoConfig config = toy_config();
  config.minibatch = 2048;
  config.sigma_start = config.sigma_end = 0.4;
  Agent agent = agent_for(2, 1, 1);
  Random random(1);
  agent.actor = nn::make_mlp<float>({2, 1}, 0.02F, random);
  PpoTrainer<toy::ToyEnvironment<toy::DoubleIntegrator>> trainer(config, kToyCourse, {agent}, world);
  Eigen::RowVector3d law = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 200; ++k) trainer.iterate(kThreads);
  for (int k = 0; k < 50; ++k) {  // the law keeps fluctuating about the optimum: take the mean
    trainer.iterate(kThreads);
    law += linear_law(trainer.learner().agent) / 50.0;
  }
  const Eigen::RowVector2d expected = riccati_gain(config.gamma);
  EXPECT_NEAR(law[0] / expected[0], 1.0, 0.05) << law << " instead of " << expected;
  EXPECT_NEAR(law[1] / expected[1], 1.0, 0.05) << law << " instead of " << expected;
  EXPECT_NEAR(law[2], 0.0, 0.05);
}

/// Mean undiscounted return of the mean policy over one episode of 64 characters.
double pendulum_return(const Agent& agent) {
  nn::Matrix<float> raw(64, toy::Pendulum::kObservation), x, means;
  nn::Workspace<float> workspace;
  Random random(77);
  List<toy::Pendulum::State> states;
  for (int i = 0; i < 64; ++i) states.push_back(toy::Pendulum::reset(random));
  double total = 0.0;
  for (int t = 0; t < toy::Pendulum::kLimit; ++t) {
    for (int i = 0; i < 64; ++i) toy::Pendulum::observe(states[i], raw.row(i).data());
    nn::normalise(agent.observations, raw, x);
    nn::evaluate(agent.actor, x, workspace, means);
    for (int i = 0; i < 64; ++i) total += toy::Pendulum::step(states[i], means.row(i).data(), random).reward;
  }
  return total / 64.0;
}

TEST(ToyTasks, PendulumSwingsUp) {
  toy::ToyEnvironment<toy::Pendulum> world(4, 32, 2);
  PpoConfig config = toy_config();
  config.sigma_start = 0.6;
  config.sigma_end = 0.15;
  const Agent untrained = agent_for(3, 1, 3);
  PpoTrainer<toy::ToyEnvironment<toy::Pendulum>> trainer(config, {.seed = 1, .falling_samples = 600'000},
                                                         {untrained}, world);
  for (int k = 0; k < 200; ++k) trainer.iterate(kThreads);
  EXPECT_LT(pendulum_return(untrained), -800.0);
  EXPECT_GT(pendulum_return(trainer.learner().agent), -250.0);
}

template <class Task>
double learned_value(const PpoConfig& config) {
  toy::ToyEnvironment<Task> world(2, 32, 4);
  PpoTrainer<toy::ToyEnvironment<Task>> trainer(config, kToyCourse, {agent_for(2, 1, 4)}, world);
  for (int k = 0; k < 150; ++k) trainer.iterate(kThreads);
  double sum = 0.0;
  for (const GroupRollout& group : trainer.buffer().groups) sum += group.values.cast<double>().sum();
  return sum / trainer.buffer().rows();
}

TEST(ToyTasks, TimeLimitsDoNotBiasTheValue) {
  PpoConfig config = toy_config();
  config.gamma = 0.9;
  // A critic that treats the time limit as a termination would give at most 6.5 to ten steps of reward 1.
  EXPECT_NEAR(learned_value<toy::ConstantReward>(config), 1.0 / (1.0 - config.gamma), 0.2);
}

TEST(ToyTasks, TerminationsEndTheValue) {
  PpoConfig config = toy_config();
  config.gamma = 0.9;
  const double expected = 1.0 / (1.0 - config.gamma * (1.0 - toy::MortalReward::kDeath));
  EXPECT_NEAR(learned_value<toy::MortalReward>(config), expected, 0.1);
}

TEST(ToyTasks, StepSizeFindsTheTargetKlFromFarBelowAndAbove) {
  for (const double start : {1e-6, 0.1}) {
    toy::ToyEnvironment<toy::DoubleIntegrator> world(4, 32, 5);
    PpoConfig config = toy_config();
    config.sigma_start = config.sigma_end = 0.1;
    config.step_size = start;
    config.step_max = 1.0;
    PpoTrainer<toy::ToyEnvironment<toy::DoubleIntegrator>> trainer(config, kToyCourse, {agent_for(2, 1, 5)},
                                                                   world);
    for (int k = 0; k < 40; ++k) trainer.iterate(kThreads);
    double kl = 0.0;
    for (int k = 0; k < 20; ++k) kl += trainer.iterate(kThreads).kl / 20.0;
    // The step size is constant while the KL is within a factor 2 of its target; single iterations scatter.
    EXPECT_GT(kl, config.kl_target / 3.0) << start;
    EXPECT_LT(kl, config.kl_target * 3.0) << start;
    EXPECT_GT(trainer.learner().step_size, 1e-4);
    EXPECT_LT(trainer.learner().step_size, 5e-2);
  }
}

}  // namespace
}  // namespace mimicx::rl
