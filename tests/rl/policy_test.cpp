#include "rl/policy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace mimicx::rl {
namespace {

using nn::Matrix;

nn::Matrix<float> random_observations(Eigen::Index rows, Eigen::Index cols, std::uint64_t seed) {
  Random random(seed);
  nn::Matrix<float> m(rows, cols);
  for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = static_cast<float>(random.normal());
  return m;
}

Agent agent_of_six() {
  AgentShape shape;
  shape.observation_dim = 6;
  shape.action_dim = 3;
  shape.hidden = {16, 8};
  return make_agent(shape, 4);
}

nn::Matrix<float> values(const Agent& agent, const nn::Matrix<float>& observations) {
  nn::Workspace<float> workspace;
  nn::Matrix<float> result;
  nn::evaluate(agent.critic, observations, workspace, result);
  unscale_values(agent.returns, result);
  return result;
}

TEST(Policy, ActionsScatterAroundTheMeanWithSigma) {
  const int n = 20000;
  const double sigma = 0.3;
  const nn::Matrix<float> means = nn::Matrix<float>::Constant(n, 2, 1.5F);
  nn::Matrix<float> actions;
  Eigen::VectorXf density(n);
  Random random(11);
  sample_actions(means, sigma, random, actions, density);
  for (int k = 0; k < 2; ++k) {
    const Eigen::ArrayXd noise = (actions.col(k) - means.col(k)).cast<double>();
    // Five standard errors of the mean and of the variance of n normal numbers.
    EXPECT_NEAR(noise.mean(), 0.0, 5.0 * sigma / std::sqrt(n));
    EXPECT_NEAR(noise.square().mean(), sigma * sigma, 5.0 * sigma * sigma * std::sqrt(2.0 / n));
  }
}

TEST(Policy, DensityIsThatOfTheSampledActions) {
  const nn::Matrix<float> means = random_observations(50, 4, 1);
  const double sigma = 0.2;
  nn::Matrix<float> actions;
  Eigen::VectorXf density(50);
  Random random(2);
  sample_actions(means, sigma, random, actions, density);
  for (Eigen::Index i = 0; i < 50; ++i) {
    const double squares = (actions.row(i) - means.row(i)).cast<double>().squaredNorm();
    EXPECT_NEAR(density[i], -squares / (2.0 * sigma * sigma), 1e-4);
  }
}

TEST(Policy, UntrainedPolicyActsNearZero) {
  const Agent agent = agent_of_six();
  nn::Workspace<float> workspace;
  nn::Matrix<float> means;
  nn::evaluate(agent.actor, random_observations(200, 6, 5), workspace, means);
  EXPECT_LT(means.cwiseAbs().maxCoeff(), 0.1F);
  EXPECT_GT(means.cwiseAbs().maxCoeff(), 0.0F);
}

TEST(Policy, ScaleOfReturnsFollowsTheirMeanAndDeviation) {
  ReturnScale scale;
  follow_returns(scale, 7.0, 49.0 + 9.0, 0.25);
  EXPECT_DOUBLE_EQ(scale.mean, 7.0);
  EXPECT_DOUBLE_EQ(scale.deviation(), 3.0);
  follow_returns(scale, 9.0, 81.0 + 9.0, 0.25);
  EXPECT_DOUBLE_EQ(scale.mean, 7.5);
}

TEST(Policy, ConstantAndZeroReturnsHaveAFiniteScale) {
  ReturnScale constant, zero;
  follow_returns(constant, 5.0, 25.0, 0.1);
  EXPECT_DOUBLE_EQ(constant.deviation(), 0.5);
  follow_returns(zero, 0.0, 0.0, 0.1);
  EXPECT_DOUBLE_EQ(zero.deviation(), 1.0);
}

TEST(Policy, ArchiveRoundTripKeepsTheAgent) {
  Agent agent = agent_of_six();
  follow_returns(agent.returns, 3.0, 11.0, 0.1);
  const std::vector<nn::Moments> seen = {nn::moments_of(random_observations(40, 6, 8))};
  nn::update(agent.observations, std::span<const nn::Moments>(seen));
  Npz archive;
  save(archive, "a.", agent);
  const Agent loaded = load_agent(archive, "a.");
  const nn::Matrix<float> raw = random_observations(20, 6, 9);
  nn::Matrix<float> x, y;
  nn::normalise(agent.observations, raw, x);
  nn::normalise(loaded.observations, raw, y);
  EXPECT_TRUE(x == y);
  EXPECT_TRUE(values(agent, x) == values(loaded, x));
  EXPECT_EQ(loaded.returns.batches, 1);
  EXPECT_THROW(load_agent(archive, "b."), DataError);
}

TEST(Policy, RejectsTextForTheScaleOfReturns) {
  Npz archive;
  save(archive, "a.", agent_of_six());
  archive.set("a.returns.scale", NpyArray::scalar_text("1.0"));
  EXPECT_THROW(load_agent(archive, "a."), DataError);
}

}  // namespace
}  // namespace mimicx::rl
