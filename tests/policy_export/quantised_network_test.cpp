// An 8-bit network: folding inputs changes nothing, and the weights equal those of the codes.
#include "policy_export/quantised_network.h"

#include <gtest/gtest.h>

#include "nn/mlp.h"
#include "policy_export/small_policy.h"

namespace mimicx::policy_export {
namespace {

std::vector<float> action_of(const rl::Agent& agent, const std::array<float, kStateCount>& observation) {
  std::vector<float> action(kActionCount);
  rl::tracking::mean_action({agent})(0, observation.data(), action.data());
  return action;
}

TEST(QuantisedNetwork, FoldingInputsKeepsTheActions) {
  rl::Agent folded = small_policy().agent;
  fold_inputs(small_policy().motion.character.betas, folded);
  const nn::Matrix<float>& W = folded.actor.weights.front();
  EXPECT_TRUE((W.middleRows(kPoseCount, kShapeCount + kPoseCount).array() == 0.0F).all());
  const auto& limit = folded.observations;
  for (const Record& record : exported_in_float().records) {
    auto observation = record.observation;  // within the limits, where nothing is clipped
    for (std::size_t k = 0; k < kPoseCount; ++k) {
      const auto at = [&](std::size_t i) { return static_cast<Eigen::Index>(i); };
      const auto kept = [&](std::size_t i, float share) {
        const float most = share / limit.factor(0, at(i));
        return limit.shift(0, at(i)) + std::clamp(observation[i] - limit.shift(0, at(i)), -most, most);
      };
      const std::size_t is = kPoseCount + kShapeCount + k, difference = is + kPoseCount;
      observation[difference] = kept(difference, 1.0F);
      observation[k] = kept(k, 1.0F);
      observation[is] = observation[k] - observation[difference];
    }
    const auto one = action_of(small_policy().agent, observation), other = action_of(folded, observation);
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 2e-5);
  }
}

TEST(QuantisedNetwork, FoldingKeepsTheActionsIfTargetsWereConstant) {
  rl::Agent agent = small_policy().agent;
  for (const Eigen::Index k : {0, 40, 100}) agent.observations.moments.squares[k] = 0.0;
  nn::refresh(agent.observations);
  ASSERT_EQ(agent.observations.factor(0, 40), 0.0F);
  rl::Agent folded = agent;
  fold_inputs(small_policy().motion.character.betas, folded);
  const auto& scale = agent.observations;
  std::array<float, kStateCount> observation{};  // at the mean of the targets and of the differences
  for (Eigen::Index i = 0; i < kStateCount; ++i) observation[static_cast<std::size_t>(i)] = scale.shift(0, i);
  for (std::size_t k = 0; k < kShapeCount; ++k)
    observation[kPoseCount + k] = static_cast<float>(small_policy().motion.character.betas[k]);
  for (std::size_t k = 0; k < kPoseCount; ++k) {
    const std::size_t is = kPoseCount + kShapeCount + k;
    observation[k] += k == 40 ? 0.01F : 0.0F;  // a value that the training has not seen
    observation[is] = observation[k] - observation[is + kPoseCount];
  }
  const auto one = action_of(agent, observation), other = action_of(folded, observation);
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 2e-5);
}

TEST(QuantisedNetwork, WeightsArePowerTimesScaleTimesCode) {
  rl::Agent agent = small_policy().agent;
  fold_inputs(small_policy().motion.character.betas, agent);
  nn::Matrix<float> seen(4, kStateCount);
  for (std::size_t r = 0; r < 4; ++r)
    seen.row(static_cast<Eigen::Index>(r)) = Eigen::Map<const nn::Matrix<float>>(
        exported_in_float().records[r].observation.data(), 1, kStateCount);
  const QuantisedNetwork small = quantise(seen, agent);
  ASSERT_EQ(small.inputs.size(), 374U);
  ASSERT_EQ(small.layers.size(), 3U);
  for (std::size_t l = 0; l < 3; ++l) {
    const nn::Matrix<float>& W = agent.actor.weights[l];
    const auto outputs = static_cast<std::size_t>(W.cols());
    for (std::size_t r = 0; r < small.layers[l].codes.size() / outputs; ++r)
      for (std::size_t o = 0; o < outputs; ++o) {
        const auto row = static_cast<Eigen::Index>(l == 0 ? static_cast<std::size_t>(small.inputs[r]) : r);
        const auto column = static_cast<Eigen::Index>(o);
        const float step = std::ldexp(small.layers[l].scales[o], l == 0 ? small.powers[r] : 0);
        EXPECT_EQ(W(row, column), step * static_cast<float>(small.layers[l].codes[r * outputs + o]));
      }
  }
}

TEST(QuantisedNetwork, ErrsLessThanPlainRounding) {
  const ExportedPolicy& exported = exported_in_float();
  nn::Matrix<float> seen(exported.motion.frames - 1, kStateCount);
  for (int t = 0; t < seen.rows(); ++t) {
    const Record record = answer(exported, t, motion_at(exported.motion.view(), t));
    seen.row(t) = Eigen::Map<const nn::Matrix<float>>(record.observation.data(), 1, kStateCount);
  }
  rl::Agent exact = small_policy().agent;
  fold_inputs(small_policy().motion.character.betas, exact);
  rl::Agent alone = exact, helped = exact;
  nn::Matrix<float> nothing(1, kStateCount);  // all inputs at their mean: no correlation between inputs
  nothing = exact.observations.shift;
  quantise(nothing, alone);
  quantise(seen, helped);
  const auto error = [&](const rl::Agent& agent) {
    nn::Matrix<float> x;
    nn::normalise(agent.observations, seen, x);
    return (x * (agent.actor.weights[0] - exact.actor.weights[0])).norm();
  };
  EXPECT_LT(error(helped), 0.5F * error(alone));
}

}  // namespace
}  // namespace mimicx::policy_export
