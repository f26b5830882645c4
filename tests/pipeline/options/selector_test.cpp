// The selector's dynamic programme against all arrangements there are.
#include "pipeline/options/selector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/random.h"

namespace mimicx::pipeline::options {
namespace {

using Rewards = OptionRewards;

/// Eq. 4, written out.
double path_value(const Rewards& reward, const std::vector<int>& options, double penalty) {
  double value = 0.0;
  for (std::size_t t = 0; t < reward.size(); ++t) {
    value += reward[t][options[t]];
    if (t + 1 < reward.size() && options[t] != options[t + 1]) value += penalty;
  }
  return value;
}

/// The best of all C^N arrangements.
double brute_force(const Rewards& reward, double penalty) {
  const int options = static_cast<int>(reward.front().size());
  std::vector<int> arrangement(reward.size(), 0);
  double best = -std::numeric_limits<double>::infinity();
  while (true) {
    best = std::max(best, path_value(reward, arrangement, penalty));
    std::size_t digit = 0;
    while (digit < arrangement.size() && ++arrangement[digit] == options) arrangement[digit++] = 0;
    if (digit == arrangement.size()) return best;
  }
}

/// Eq. 5 as printed: the reward of the option one comes from.
std::vector<int> printed_recursion(const Rewards& reward, double penalty) {
  const std::size_t frames = reward.size(), options = reward.front().size();
  std::vector<std::vector<double>> dp = {reward.front()};
  std::vector<std::vector<std::size_t>> from(frames, std::vector<std::size_t>(options));
  for (std::size_t t = 1; t < frames; ++t) {
    dp.emplace_back(options, -std::numeric_limits<double>::infinity());
    for (std::size_t c = 0; c < options; ++c)
      for (std::size_t b = 0; b < options; ++b) {
        const double value = dp[t - 1][b] + reward[t][b] + (b == c ? 0.0 : penalty);
        if (value > dp[t][c]) dp[t][c] = value, from[t][c] = b;
      }
  }
  std::vector<int> out(frames);
  auto c = static_cast<std::size_t>(std::max_element(dp.back().begin(), dp.back().end()) - dp.back().begin());
  for (std::size_t t = frames; t-- > 0; c = from[t][c]) out[t] = static_cast<int>(c);
  return out;
}

struct Problem {
  Rewards reward;
  double penalty;
};

/// Rewards are multiples of 1/64, so that sums are exact in any order: 2 to 7 frames, 1 to 4 options.
Problem random_problem(std::uint64_t seed) {
  Random random(seed, {0x73656c});
  Problem p;
  p.reward.assign(2 + random.below(6), List<double>(1 + random.below(4)));
  for (auto& row : p.reward)
    for (double& r : row) r = random.below(65) / 64.0;
  p.penalty = -static_cast<double>(random.below(33)) / 64.0;
  return p;
}

TEST(Selector, ReachesTheOptimumOfAllArrangements) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Problem p = random_problem(seed);
    const Arrangement found = select_options(p.reward, p.penalty);
    ASSERT_EQ(found.options.size(), p.reward.size());
    EXPECT_EQ(found.value, brute_force(p.reward, p.penalty)) << "problem " << seed;
    EXPECT_EQ(path_value(p.reward, found.options, p.penalty), found.value) << "problem " << seed;
  }
}

// By hand, w_p = −1/8: the printed recursion gives dp(2, 0) = dp(1, 0) + r_2^0 = 1 and dp(2, 1) = dp(1, 1) +
// r_2^1 = 1, both without a switch. Option 0 and then 1 earns 2 − 1/8.
TEST(Selector, PrintedRecursionMissesTheSwitchOfTwoFrames) {
  const Rewards reward = {{1, 0}, {0, 1}};
  EXPECT_EQ(path_value(reward, printed_recursion(reward, -0.125), -0.125), 1.0);
  EXPECT_EQ(brute_force(reward, -0.125), 1.875);
  EXPECT_EQ(select_options(reward, -0.125).options, (std::vector<int>{0, 1}));
}

// Rewards are exact in binary and the random numbers our own, so the count is the same on every machine.
TEST(Selector, PrintedRecursionIsNotOptimal) {
  int missed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Problem p = random_problem(seed);
    const double printed = path_value(p.reward, printed_recursion(p.reward, p.penalty), p.penalty);
    missed += printed < brute_force(p.reward, p.penalty);
  }
  EXPECT_EQ(missed, 134) << "docs/method.md §8 says so";
}

TEST(Selector, WithoutPenaltyEveryFrameGetsItsBestOption) {
  const Rewards reward = {{1, 2, 3}, {3, 2, 1}, {1, 3, 2}};
  EXPECT_EQ(select_options(reward, 0.0).options, (std::vector<int>{2, 0, 1}));
}

TEST(Selector, LargePenaltyKeepsOneOption) {
  const Rewards reward = {{1, 0}, {0, 1.25}, {1, 0}, {0, 1}};
  const Arrangement found = select_options(reward, -100.0);
  EXPECT_EQ(found.options, (std::vector<int>{1, 1, 1, 1}));
  EXPECT_EQ(found.value, 2.25);
}

TEST(Selector, SwitchesExactlyWhenItPays) {
  const Rewards reward = {{1, 0}, {1, 0}, {0, 1}, {0, 1}};
  EXPECT_EQ(select_options(reward, -1.75).options, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(select_options(reward, -2.25).options, (std::vector<int>{0, 0, 0, 0}));
}

TEST(Selector, TiesStayAndThenTakeTheLowerIndex) {
  EXPECT_EQ(select_options(Rewards(4, {1, 1, 1}), 0.0).options, (std::vector<int>{0, 0, 0, 0}));
  // Switching away from 1 and back would give as much as staying.
  EXPECT_EQ(select_options({{0, 1}, {1, 1}, {0, 1}}, 0.0).options, (std::vector<int>{1, 1, 1}));
  // The switch costs exactly what it brings: the last frame stays with what came before.
  EXPECT_EQ(select_options({{2, 0}, {0, 1}}, -1.0).options, (std::vector<int>{0, 0}));
  // Options 0 and 1 are equally good to come from.
  EXPECT_EQ(select_options({{1, 1, 0}, {0, 0, 2}}, -0.5).options, (std::vector<int>{0, 2}));
}

TEST(Selector, RejectsInputsWithoutAnOptimum) {
  EXPECT_TRUE(select_options({}, -1.0).options.empty());
  EXPECT_THROW(select_options({{1, 2}, {1}}, -1.0), std::invalid_argument);
  EXPECT_THROW(select_options({{}, {}}, -1.0), std::invalid_argument);
  EXPECT_THROW(select_options({{1, 2}}, 0.5), std::invalid_argument);
  EXPECT_THROW(select_options({{1, std::numeric_limits<double>::quiet_NaN()}}, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::pipeline::options
