#include "pipeline/options/arrangement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/setting_checks.h"
#include "pipeline/options/constant_option.h"
#include "pipeline/options/option_rewards.h"
#include "pipeline/options/two_poses.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {
namespace {

constexpr double kRescue = 0.3;

ArrangementConfig by_programme(double switch_penalty, double rescue_reward) {
  return {.switch_penalty = switch_penalty,
          .rescue = {rescue_reward},
          .selector = Selector::kDp,
          .rescue_frames = 0};
}

/// A set of options without encoders, by their constant actions.
OptionSet set_of(const std::vector<float>& actions) {
  OptionSet set;
  for (const float action : actions) {
    TrainedOption trained;
    trained.option = constant_option(rl::tracking::kStateSize, action);
    set.options.push_back(trained);
  }
  return set;
}

/// Eq. 4 of options that act in frames 0 … N − 2, each towards the frame after it.
double arrangement_value(const OptionRewards& rewards, const List<int>& options, double switch_penalty) {
  double value = 0.0;
  for (int t = 0; t + 1 < rewards.count(); ++t) {
    value += rewards[t + 1][options[t]];
    if (t > 0 && options[t] != options[t - 1]) value += switch_penalty;
  }
  return value;
}

TEST(Arrangement, IsTheBestOfAll) {
  constexpr int kFrames = 14, kActing = kFrames - 1;
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(kFrames), {});
  const OptionSet set = set_of({0.02F, -0.02F});
  const Option &first = set.options[0].option, &second = set.options[1].option;
  const SideBySide rolled = roll_out_side_by_side(clip, {}, {&first, &second}, {kRescue});
  std::size_t most = 0;
  for (const double penalty : {0.0, -1e-3, -1.0}) {
    const ArrangedClip arranged = arrange(clip, {}, set, by_programme(penalty, kRescue));
    ASSERT_EQ(arranged.options.count(), kFrames);
    double best = -1e9;
    for (int bits = 0; bits < 1 << kActing; ++bits) {
      List<int> options;
      for (int t = 0; t < kActing; ++t) options.push_back(bits >> t & 1);
      best = std::max(best, arrangement_value(rolled.rewards, options, penalty));
    }
    EXPECT_NEAR(arrangement_value(rolled.rewards, arranged.options, penalty), best, 1e-12) << penalty;
    most = std::max(most, arranged.kept.size());
    EXPECT_EQ(arranged.options.back(), arranged.options[kActing - 1]) << "nothing is left to do there";
  }
  EXPECT_EQ(most, 2u) << "without a switch this would prove little";
}

TEST(Arrangement, KeepsAndRenumbersTheActingOptions) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const OptionSet set = set_of({1.5F, 0.02F, 1.5F, -0.02F});  // 0 and 2 make the character fall
  const ArrangedClip arranged = arrange(clip, {}, set, by_programme(0.0, kRescue));
  EXPECT_EQ(arranged.kept, (std::vector<int>{1, 3}));
  ASSERT_EQ(arranged.agents.size(), 2u);
  for (int k = 0; k < 2; ++k)
    EXPECT_TRUE(arranged.agents[k].actor.biases.back() ==
                set.options[arranged.kept[k]].option.agent.actor.biases.back());
  ASSERT_EQ(arranged.clip->arrangement.size(), 30u);
  for (std::size_t t = 0; t < 30; ++t)
    EXPECT_EQ(arranged.kept[arranged.clip->arrangement[t]], arranged.options[t]);
  EXPECT_TRUE(clip->arrangement.empty()) << "the clip that was given is as it was";
}

TEST(Arrangement, ClipIsEncodedByTheKeptOptionsInOrder) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(20), {});
  OptionSet set;
  for (int k = 0; k < 2; ++k) {
    TrainedOption trained;
    trained.option = constant_option(rl::tracking::kEncodedRest + 8, k == 0 ? 1.5F : 0.0F);
    trained.option.encoder = some_encoder(*clip, static_cast<std::uint64_t>(k));
    set.options.push_back(trained);
  }
  const ArrangedClip arranged = arrange(clip, {}, set, by_programme(-10.0, kRescue));
  ASSERT_EQ(arranged.kept, std::vector<int>{1});
  ASSERT_EQ(arranged.clip->encoded.size(), 1u);
  EXPECT_EQ(arranged.clip->encoded[0].codes, encode_reference(*set.options[1].option.encoder, *clip).codes);
}

TEST(Arrangement, ListsFramesThatNoOptionFollows) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  EXPECT_TRUE(arrange(clip, {}, set_of({0.0F}), by_programme(0.0, kRescue)).breaks.empty());
  const OptionSet bad = set_of({1.5F, 1.5F});
  const Option& option = bad.options[0].option;
  EXPECT_EQ(arrange(clip, {}, bad, by_programme(0.0, kRescue)).breaks,
            roll_out_side_by_side(clip, {}, {&option, &option}, {kRescue}).breaks);
  EXPECT_FALSE(arrange(clip, {}, bad, by_programme(0.0, kRescue)).breaks.empty());
}

TEST(Arrangement, RescueRewardChangesTheRollOut) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const OptionSet set = set_of({0.3F});
  EXPECT_NE(arrange(clip, {}, set, by_programme(0.0, 1e-9)).breaks,
            arrange(clip, {}, set, by_programme(0.0, 0.9999)).breaks);
}

constexpr int kHalves = 60;

ArrangementConfig selecting(Selector selector) {
  return {.switch_penalty = -1.0,
          .rescue = {0.1},
          .selector = selector,
          .rescue_frames = 30,
          .beam_width = 4,
          .beam_stretch = 5,
          .beam_retries = 0};
}

/// One option is right in each half.
ArrangedClip arrange_halves(Selector selector) {
  const auto clip = rl::tracking::make_tracking_clip(two_poses(kHalves), absolute_actions());
  return arrange(clip, absolute_actions(), options_of_halves(clip->reference), selecting(selector));
}

TEST(Arrangement, DynamicProgrammeAndBeamFindTheSwitch) {
  for (const Selector selector : {Selector::kDp, Selector::kBeam}) {
    const auto stretches = stretches_of(arrange_halves(selector).options);
    ASSERT_EQ(stretches.size(), 2u) << static_cast<int>(selector);
    EXPECT_EQ(stretches[0][1], 1) << "hanging arms come first";
    EXPECT_EQ(stretches[1][1], 0);
    // The arms rise from frame 26 to 34; who switches two frames ahead has begun when they do.
    EXPECT_NEAR(stretches[1][0], kHalves / 2, 6) << static_cast<int>(selector);
  }
}

TEST(Arrangement, SwitchFollowsBetterThanTheBestSingleOption) {
  const auto reward_of = [](const ArrangedClip& arranged) {
    return rl::tracking::roll_out(arranged.clip, absolute_actions(),
                                  rl::tracking::mean_action(arranged.agents))
        .mean_reward;
  };
  const ArrangedClip single = arrange_halves(Selector::kSingle);
  EXPECT_EQ(single.kept.size(), 1u);
  for (const Selector selector : {Selector::kDp, Selector::kBeam})
    EXPECT_GT(reward_of(arrange_halves(selector)), 1.2 * reward_of(single));
}

TEST(Arrangement, SingleIsTheOptionOfLargestOwnReward) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const OptionSet set = set_of({1.5F, 0.05F, 0.0F, -0.1F});
  const ArrangedClip arranged = arrange(clip, {}, set, selecting(Selector::kSingle));
  int best = 0;
  double most = 0.0;
  for (int k = 0; k < set.options.count(); ++k) {
    const double reward =
        rl::tracking::roll_out(clip, {}, rl::tracking::mean_action({set.options[k].option.agent}))
            .mean_reward;
    if (reward > most) most = reward, best = k;
  }
  EXPECT_EQ(arranged.options, List<int>(30, best));
}

TEST(Arrangement, NearestIsTheOptionOfTheNearestCentre) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  OptionSet set = set_of({0.0F, 0.0F, 0.0F});
  const MotionFeatures features = motion_features(clip->reference);
  for (int k = 0; k < 3; ++k) {
    set.options[k].centre = features;
    set.options[k].centre[kAcceleration] += std::abs(k - 1) + 0.5;
  }
  EXPECT_EQ(arrange(clip, {}, set, selecting(Selector::kNearest)).options, List<int>(30, 1));
}

TEST(Arrangement, EverySettingCanBeChangedByItsNameAndChangesNoOther) { check_settings(ArrangementConfig{}); }

TEST(Arrangement, RejectsImpossibleValues) {
  const ArrangementConfig good = selecting(Selector::kBeam);
  EXPECT_NO_THROW(require_ranges(good));
  for (const auto& spoil : std::vector<void (*)(ArrangementConfig&)>{
           [](ArrangementConfig& c) { c.rescue_frames = -1; }, [](ArrangementConfig& c) { c.beam_width = 0; },
           [](ArrangementConfig& c) { c.beam_stretch = 0; },
           [](ArrangementConfig& c) { c.beam_retries = -1; },
           [](ArrangementConfig& c) { c.beam_retries = 6; },
           [](ArrangementConfig& c) { c.selector = static_cast<Selector>(4); }}) {
    ArrangementConfig config = good;
    spoil(config);
    EXPECT_THROW(require_ranges(config), std::invalid_argument);
  }
}

TEST(Stretches, GiveTheFirstFrameOfEachOption) {
  using List = std::vector<std::array<int, 2>>;
  EXPECT_EQ(stretches_of({}), List{});
  EXPECT_EQ(stretches_of({4}), (List{{0, 4}}));
  EXPECT_EQ(stretches_of({2, 2, 0, 0, 0, 2}), (List{{0, 2}, {2, 0}, {5, 2}}));
}

}  // namespace
}  // namespace mimicx::pipeline::options
