// Rescues: who is rescued, and what it costs.
#include "pipeline/options/option_rewards.h"

#include <gtest/gtest.h>

#include "pipeline/options/constant_option.h"

namespace mimicx::pipeline::options {
namespace {

/// One option earns 0.6 in every frame; the other earns 0.9 until it fails, every `period` frames, and is
/// handed the state of the first.
SideBySide steady_and_failing(int frames, int period) {
  SideBySide rolled;
  for (int t = 0; t < frames; ++t) {
    const bool fails = t > 0 && t % period == 0;
    rolled.rewards.push_back({0.6, fails ? 0.0 : 0.9});
    rolled.rescued.push_back({false, fails});
  }
  return rolled;
}

TEST(Rescues, RewardFadesToZeroAtTheRescue) {
  SideBySide rolled;
  rolled.rewards.assign(7, {1.0, 0.5});
  rolled.rescued.assign(7, {false, false});
  rolled.rescued[4][0] = true;
  const OptionRewards charged = charge_rescues(rolled, 4);
  const List<double> expected = {1.0, 0.75, 0.5, 0.25, 0.0, 1.0, 1.0};
  for (int t = 0; t < 7; ++t) {
    EXPECT_EQ(charged[t][0], expected[t]) << t;
    EXPECT_EQ(charged[t][1], 0.5) << "the other option is not to blame";
  }
}

TEST(Rescues, EachFrameIsChargedForTheNextRescueOnly) {
  SideBySide rolled;
  rolled.rewards.assign(6, {1.0});
  rolled.rescued.assign(6, {false});
  rolled.rescued[2][0] = rolled.rescued[4][0] = true;
  const OptionRewards charged = charge_rescues(rolled, 4);
  const List<double> expected = {0.5, 0.25, 0.0, 0.25, 0.0, 1.0};
  for (int t = 0; t < 6; ++t) EXPECT_EQ(charged[t][0], expected[t]) << t;
}

TEST(Rescues, CostNothingWithoutFailuresOrWithZeroFrames) {
  EXPECT_EQ(charge_rescues(steady_and_failing(20, 100), 10), steady_and_failing(20, 100).rewards);
  EXPECT_EQ(charge_rescues(steady_and_failing(20, 5), 0), steady_and_failing(20, 5).rewards);
}

TEST(Rescues, ChargesStopThePreferenceForARescuedOption) {
  const SideBySide rolled = steady_and_failing(120, 20);
  const auto chosen = [&](int frames) {
    return select_options(charge_rescues(rolled, frames), -1000.0).options.front();
  };
  EXPECT_EQ(chosen(0), 1) << "free rescues reward it";
  EXPECT_EQ(chosen(30), 0);
}

TEST(Rescues, OnlyFailingOptionsAreRescued) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option good = constant_option(rl::tracking::kStateSize, 0.0F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide rolled = roll_out_side_by_side(clip, {}, {&bad, &good}, {0.3});
  ASSERT_EQ(rolled.rescued.count(), 30);
  int rescues = 0;
  for (int t = 0; t < 30; ++t) {
    EXPECT_FALSE(rolled.rescued[t][1]) << t;
    EXPECT_EQ(rolled.rescued[t][0], rolled.rewards[t][0] < 0.3) << t;
    if (rolled.rescued[t][0]) ++rescues;
  }
  EXPECT_GT(rescues, 1);
}

TEST(Rescues, FailingOptionGetsTheStateOfTheBestOneNotOfAnyThatHolds) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option best = constant_option(rl::tracking::kStateSize, 0.0F),
               holds = constant_option(rl::tracking::kStateSize, 0.01F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide alone = roll_out_side_by_side(clip, {}, {&bad, &best}, {0.3}),
                   beside = roll_out_side_by_side(clip, {}, {&bad, &holds, &best}, {0.3});
  int rescues = 0;
  for (int t = 1; t < 30 && beside.rewards[t][1] < beside.rewards[t][2]; ++t) {
    EXPECT_FALSE(beside.rescued[t][1]) << t;
    EXPECT_EQ(beside.rewards[t][0], alone.rewards[t][0]) << t << ": it goes on from the state of the best";
    if (beside.rescued[t][0]) ++rescues;
  }
  EXPECT_GT(rescues, 1);
}

// A fallen character earns 0, which a threshold of 0 does not exceed.
TEST(Rescues, FallsAreRescuedAtAThresholdOfZero) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option good = constant_option(rl::tracking::kStateSize, 0.0F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide rolled = roll_out_side_by_side(clip, {}, {&bad, &good}, {0.0, 0.05});
  int rescues = 0;
  for (int t = 0; t < 30; ++t) {
    for (int c = 0; c < 2; ++c) EXPECT_EQ(rolled.rescued[t][c], rolled.rewards[t][c] == 0.0) << t << " " << c;
    if (rolled.rescued[t][0]) ++rescues;
  }
  EXPECT_GT(rescues, 1);
}

// The paper's rule: what counts is the reward alone, wherever the body is.
TEST(Rescues, NoDistanceCallsForARescueWhereItIsBeyondReach) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option good = constant_option(rl::tracking::kStateSize, 0.0F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  constexpr double kAnyReward = 1e-12;
  const SideBySide by_both = roll_out_side_by_side(clip, {}, {&bad, &good}, {kAnyReward, 0.05}),
                   by_reward = roll_out_side_by_side(clip, {}, {&bad, &good}, {kAnyReward, 1000.0});
  int rescued = 0, earned = 0;
  for (int t = 1; t < 30; ++t) {
    if (by_both.rescued[t][0]) ++rescued;
    EXPECT_EQ(by_reward.rescued[t][0], by_reward.rewards[t][0] < kAnyReward) << t;
    if (by_reward.rewards[t][0] >= kAnyReward) ++earned;
  }
  EXPECT_GT(rescued, 1);
  EXPECT_GT(earned, 1) << "a body that is far away earns what Eqs. 2 and 3 say";
}

}  // namespace
}  // namespace mimicx::pipeline::options
