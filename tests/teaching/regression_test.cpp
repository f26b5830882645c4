// Gradient steps against what they must come to.
#include "teaching/regression.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace mimicx::teaching {
namespace {

/// Lessons of `rows` random states in `frames` frames, labelled by `label(row, k)`.
template <class Label>
Lessons random_lessons(int rows, int frames, int state_size, const Label& label) {
  Random random(7);
  Lessons lessons;
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < state_size; ++k) lessons.states.push_back(static_cast<float>(random.normal()));
    for (int k = 0; k < kDofs; ++k) lessons.actions.push_back(label(row, k));
    lessons.weighed_by.push_back(row % frames);
  }
  return lessons;
}

rl::Agent agent_of(int state_size, std::vector<int> hidden) {
  rl::AgentShape shape;
  shape.observation_dim = state_size;
  shape.action_dim = kDofs;
  shape.hidden = std::move(hidden);
  shape.last_scale = 0.5f;
  return rl::make_agent(shape, 1);
}

List<int> all_rows(const Lessons& lessons) {
  List<int> rows;
  for (int row = 0; row < lessons.rows(); ++row) rows.push_back(row);
  return rows;
}

PolicyInTraining in_training(rl::Agent agent) {
  PolicyInTraining policy{std::move(agent), {}};
  policy.adam = nn::make_adam<float>(nn::parameters(policy.agent.actor));
  return policy;
}

double loss_of(const Lessons& lessons, const List<Eigen::MatrixXf>& importance, rl::Agent agent,
               int slots = 2) {
  PolicyInTraining policy = in_training(std::move(agent));
  const List<int> rows = all_rows(lessons);
  RegressionScratch scratch;
  RegressionConfig config;
  config.slots = slots;
  return regression_step({lessons, importance}, {rows, 0.0}, config, 1, policy, scratch);
}

TEST(Regression, LossIsTheMeanWeightedSquare) {
  const int rows = 12, frames = 3, size = 5;
  const Lessons lessons =
      random_lessons(rows, frames, size, [](int row, int k) { return 0.01f * float(row - k); });
  List<Eigen::MatrixXf> importance;
  for (int t = 0; t < frames; ++t) {
    const Eigen::MatrixXf A = Eigen::MatrixXf::Random(kDofs, kDofs);
    importance.push_back(A * A.transpose());
  }
  const rl::Agent agent = agent_of(size, {4});
  double expected = 0.0;
  nn::Workspace<float> workspace;
  nn::Matrix<float> states = Eigen::Map<const nn::Matrix<float>>(lessons.states.data(), rows, size), means;
  nn::normalise(agent.observations, states, states);
  nn::evaluate(agent.actor, states, workspace, means);
  for (int row = 0; row < rows; ++row) {
    Eigen::VectorXd error(kDofs);
    for (int k = 0; k < kDofs; ++k)
      error[k] = double{means(row, k)} - double{lessons.actions[row * kDofs + k]};
    expected += 0.5 / rows * error.dot(importance[row % frames].cast<double>() * error);
  }
  EXPECT_NEAR(loss_of(lessons, importance, agent), expected, 1e-5 * expected);
}

// A network that sees nothing can only answer one thing: the mean of the labels under their weights.
TEST(Regression, EqualStatesLearnTheWeightedMean) {
  Lessons lessons = random_lessons(4, 2, 3, [](int row, int) { return row % 2 == 0 ? 1.0f : 5.0f; });
  std::fill(lessons.states.begin(), lessons.states.end(), 0.0f);
  const List<Eigen::MatrixXf> importance = {3.0f * Eigen::MatrixXf::Identity(kDofs, kDofs),
                                            Eigen::MatrixXf::Identity(kDofs, kDofs)};
  PolicyInTraining policy = in_training(agent_of(3, {}));
  RegressionScratch scratch;
  const List<int> rows = all_rows(lessons);
  for (int step = 0; step < 3000; ++step)
    regression_step({lessons, importance}, {rows, 0.02 / (1 + 0.01 * step)}, {}, 1, policy, scratch);
  for (int k = 0; k < kDofs; ++k)
    EXPECT_NEAR(policy.agent.actor.biases[0](0, k), (3 * 1.0 + 5.0) / 4, 1e-3) << k;
}

TEST(Regression, StepsReduceTheLoss) {
  const Lessons lessons =
      random_lessons(64, 4, 6, [](int row, int k) { return 0.3f * float((row * k) % 5); });
  const List<Eigen::MatrixXf> importance(4, Eigen::MatrixXf(Eigen::MatrixXf::Identity(kDofs, kDofs)));
  PolicyInTraining policy = in_training(agent_of(6, {32}));
  RegressionScratch scratch;
  const List<int> rows = all_rows(lessons);
  const double before = loss_of(lessons, importance, policy.agent);
  for (int step = 0; step < 200; ++step)
    regression_step({lessons, importance}, {rows, 3e-3}, {}, 1, policy, scratch);
  EXPECT_LT(loss_of(lessons, importance, policy.agent), 0.3 * before);
}

TEST(Regression, ThreadsDoNotChangeABit) {
  const Lessons lessons = random_lessons(50, 4, 6, [](int row, int k) { return 0.1f * float(row % 7 + k); });
  const List<Eigen::MatrixXf> importance(4, Eigen::MatrixXf(Eigen::MatrixXf::Identity(kDofs, kDofs)));
  const auto trained = [&](int threads) {
    PolicyInTraining policy = in_training(agent_of(6, {8}));
    const List<int> rows = all_rows(lessons);
    RegressionScratch scratch;
    RegressionConfig config;
    config.slots = 4;
    for (int step = 0; step < 5; ++step)
      regression_step({lessons, importance}, {rows, 1e-2}, config, threads, policy, scratch);
    return policy.agent.actor.weights[0];
  };
  EXPECT_EQ(trained(1), trained(2));
}

}  // namespace
}  // namespace mimicx::teaching
