// Which of several sets of options a motion is given to.
#include "pipeline/option_set_choice.h"

#include <gtest/gtest.h>

#include "pipeline/options/constant_option.h"

namespace mimicx::pipeline {
namespace {

constexpr int kFrames = 60;

struct OptionSetChoice : testing::Test {
  using Set = std::shared_ptr<const options::OptionSet>;

  /// Two options without encoders, the first of which falls at once and the second of which always does this.
  /// 0 follows, 0.2 falls and 1.5 falls at once.
  static Set set_of(float action) {
    options::OptionSet set;
    for (const float always : {-1.5F, action}) {
      set.options.emplace_back();
      set.options.back().option = options::constant_option(rl::tracking::kStateSize, always);
    }
    return std::make_shared<const options::OptionSet>(std::move(set));
  }
  /// One option with an encoder: no option without one could be in an arrangement with it.
  Set encoded_set_of(float action) const {
    options::OptionSet set;
    set.options.emplace_back();
    set.options[0].option = options::constant_option(rl::tracking::kEncodedRest + 8, action);
    set.options[0].option.encoder = options::some_encoder(*clip);
    return std::make_shared<const options::OptionSet>(std::move(set));
  }
  ChosenSet choose(const options::OptionSets& sets, const std::function<bool()>& should_stop = {}) const {
    return choose_set(reference, clip, {}, sets, config, should_stop);
  }

  motion::Reference reference = rl::tracking::swaying_reference(kFrames);
  std::shared_ptr<const rl::tracking::TrackingClip> clip = rl::tracking::make_tracking_clip(reference, {});
  options::ArrangementConfig config{
      .switch_penalty = 0.0, .beam_width = 4, .beam_stretch = 5, .beam_retries = 0};
};

TEST_F(OptionSetChoice, TakesTheFirstThatFollowsAndTriesNoOther) {
  int asked = 0;
  const auto count = [&] { return ++asked < 0; };
  const ChosenSet first = choose({set_of(0.0F), encoded_set_of(0.0F)}, count);
  EXPECT_EQ(first.set, 0);
  EXPECT_EQ(asked, kFrames - 1) << "a search asks once per frame";
  EXPECT_EQ(choose({set_of(1.5F), encoded_set_of(0.0F), set_of(0.0F)}).set, 1);
}

TEST_F(OptionSetChoice, ArrangementIsThatOfTheSetAlone) {
  const Set follows = set_of(0.01F);
  const ChosenSet chosen = choose({encoded_set_of(1.5F), follows});
  const options::ArrangedClip alone = options::arrange(clip, {}, *follows, config);
  EXPECT_EQ(chosen.set, 1);
  EXPECT_EQ(chosen.arranged.options, alone.options);
  EXPECT_EQ(chosen.arranged.kept, alone.kept);
  EXPECT_EQ(chosen.arranged.kept, std::vector<int>{1});
  EXPECT_TRUE(chosen.arranged.clip->encoded.empty());
  EXPECT_EQ(chosen.last_searched, kFrames - 1);
  EXPECT_TRUE(chosen.success);
  EXPECT_EQ(chosen.tried, 2);
}

TEST_F(OptionSetChoice, TakesTheBestIfNoneFollowsAndTheFirstOfEquals) {
  EXPECT_EQ(choose({set_of(1.5F), set_of(1.5F)}).set, 0);
  EXPECT_FALSE(choose({set_of(1.5F), set_of(1.5F)}).success);
  const Set falls = set_of(1.5F), falls_later = set_of(0.2F);
  EXPECT_EQ(choose({falls, falls_later}).set, 1);
  EXPECT_EQ(choose({falls_later, falls}).set, 0);
  EXPECT_THROW(choose({}), std::invalid_argument);
}

/// A search can come to the end of a motion that it has drifted away from: no break, and yet no success.
TEST_F(OptionSetChoice, ReachingTheEndIsNotEnoughToFollow) {
  rl::tracking::TrackingConfig lenient;
  lenient.terminate_distance = 5.0;
  const Set falls = set_of(1.5F);
  ASSERT_TRUE(options::arrange(clip, lenient, *falls, config).breaks.empty());
  EXPECT_EQ(choose_set(reference, clip, lenient, {falls, set_of(0.0F)}, config).set, 1);
}

TEST_F(OptionSetChoice, TakesAStoppedSearchOnlyIfThereIsNoOther) {
  const Set falls = set_of(1.5F), follows = set_of(0.0F);
  const auto after = [](int frames) { return [left = frames]() mutable { return left-- <= 0; }; };
  const ChosenSet first = choose({falls, follows}, after(12));
  EXPECT_EQ(first.set, 0);
  EXPECT_EQ(first.last_searched, 10) << "whole stretches of 5 frames";
  EXPECT_EQ(first.tried, 1);
  const ChosenSet second = choose({falls, follows}, after(kFrames - 1 + 1 + 12));
  EXPECT_EQ(second.set, 0);
  EXPECT_EQ(second.last_searched, 10);
  EXPECT_EQ(second.tried, 2);
  EXPECT_EQ(second.arranged.searched, kFrames - 1) << "the first search is as it was";
  EXPECT_EQ(second.arranged.options, options::arrange(clip, {}, *falls, config).options);
}

}  // namespace
}  // namespace mimicx::pipeline
