#include "pipeline/options/arrangement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/options/constant_option.h"
#include "pipeline/options/side_by_side.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::pipeline::options {
namespace {

constexpr double kRescue = 0.3;

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
double value_of(const OptionRewards& rewards, const List<int>& options, double switch_penalty) {
  double value = 0.0;
  for (int t = 0; t + 1 < rewards.count(); ++t) {
    value += rewards[t + 1][options[t]];
    if (t > 0 && options[t] != options[t - 1]) value += switch_penalty;
  }
  return value;
}

TEST(Arrangement, IsTheBestOfAllThatThereAre) {
  constexpr int kFrames = 8, kActing = kFrames - 1;
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(kFrames), {});
  const OptionSet set = set_of({0.02F, -0.02F});
  const Option &first = set.options[0].option, &second = set.options[1].option;
  const SideBySide rolled = roll_out_side_by_side(clip, {}, {&first, &second}, kRescue);
  std::size_t most = 0;
  for (const double penalty : {0.0, -1e-3, -1.0}) {
    const ArrangedClip arranged = arrange(clip, {}, set, {penalty, kRescue});
    ASSERT_EQ(arranged.options.count(), kFrames);
    double best = -1e9;
    for (int bits = 0; bits < 1 << kActing; ++bits) {
      List<int> options;
      for (int t = 0; t < kActing; ++t) options.push_back(bits >> t & 1);
      best = std::max(best, value_of(rolled.rewards, options, penalty));
    }
    EXPECT_NEAR(value_of(rolled.rewards, arranged.options, penalty), best, 1e-12) << penalty;
    most = std::max(most, arranged.kept.size());
    EXPECT_EQ(arranged.options.back(), arranged.options[kActing - 1]) << "nothing is left to do there";
  }
  EXPECT_EQ(most, 2u) << "without a switch this would prove little";
}

TEST(Arrangement, KeepsTheOptionsThatActAndNumbersThemAnew) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const OptionSet set = set_of({1.5F, 0.02F, 1.5F, -0.02F});  // 0 and 2 make the character fall
  const ArrangedClip arranged = arrange(clip, {}, set, {0.0, kRescue});
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

TEST(Arrangement, TheClipIsEncodedByTheKeptOptionsInTheirOrder) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(20), {});
  OptionSet set;
  for (int k = 0; k < 2; ++k) {
    TrainedOption trained;
    trained.option = constant_option(rl::tracking::kEncodedRest + 8, k == 0 ? 1.5F : 0.0F);
    trained.option.encoder = some_encoder(*clip, static_cast<std::uint64_t>(k));
    set.options.push_back(trained);
  }
  const ArrangedClip arranged = arrange(clip, {}, set, {-10.0, kRescue});
  ASSERT_EQ(arranged.kept, std::vector<int>{1});
  ASSERT_EQ(arranged.clip->encoded.size(), 1u);
  EXPECT_EQ(arranged.clip->encoded[0].codes, encode_reference(*set.options[1].option.encoder, *clip).codes);
}

TEST(Arrangement, NamesTheFramesThatNoOptionCouldFollow) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  EXPECT_TRUE(arrange(clip, {}, set_of({0.0F}), {0.0, kRescue}).breaks.empty());
  const OptionSet bad = set_of({1.5F, 1.5F});
  const Option& option = bad.options[0].option;
  EXPECT_EQ(arrange(clip, {}, bad, {0.0, kRescue}).breaks,
            roll_out_side_by_side(clip, {}, {&option, &option}, kRescue).breaks);
  EXPECT_FALSE(arrange(clip, {}, bad, {0.0, kRescue}).breaks.empty());
}

TEST(Arrangement, ARescueAtAHigherRewardIsAnotherRollOut) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const OptionSet set = set_of({0.3F});
  EXPECT_NE(arrange(clip, {}, set, {0.0, 1e-9}).breaks, arrange(clip, {}, set, {0.0, 0.9999}).breaks);
}

TEST(Stretches, SayWhereEachOptionBegins) {
  using List = std::vector<std::array<int, 2>>;
  EXPECT_EQ(stretches_of({}), List{});
  EXPECT_EQ(stretches_of({4}), (List{{0, 4}}));
  EXPECT_EQ(stretches_of({2, 2, 0, 0, 0, 2}), (List{{0, 2}, {2, 0}, {5, 2}}));
}

}  // namespace
}  // namespace mimicx::pipeline::options
