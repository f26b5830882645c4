// The search against the roll-outs that it stands for.
#include "pipeline/options/beam_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/options/two_poses.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {
namespace {

using Clip = std::shared_ptr<const rl::tracking::TrackingClip>;

/// Eq. 4 of what the options really earn when they act in turn.
double search_value(const Clip& clip, const rl::tracking::TrackingConfig& tracking,
                    const std::vector<const Option*>& options, const List<int>& acting,
                    double switch_penalty) {
  auto arranged = std::make_shared<rl::tracking::TrackingClip>(*clip);
  arranged->arrangement = acting;
  arranged->arrangement.push_back(acting.back());
  std::vector<rl::Agent> agents;
  for (const Option* option : options) agents.push_back(option->agent);
  const rl::tracking::TrackingRollout rolled =
      rl::tracking::roll_out(arranged, tracking, rl::tracking::mean_action(agents));
  EXPECT_LT(rolled.worst_distance, tracking.terminate_distance) << "it should stand";
  double value = 0.0;
  for (int t = 0; t < acting.count(); ++t) {
    value += rolled.rewards[static_cast<std::size_t>(t) + 1].total;
    if (t > 0 && acting[t] != acting[t - 1]) value += switch_penalty;
  }
  return value;
}

struct Halves {
  explicit Halves(int frames)
      : clip(rl::tracking::make_tracking_clip(two_poses(frames), absolute_actions())),
        set(options_of_halves(clip->reference)),
        options{&set.options[0].option, &set.options[1].option} {}
  Clip clip;
  OptionSet set;
  std::vector<const Option*> options;
};

TEST(BeamSearch, ValueIsThatOfTheRollOut) {
  const Halves halves(40);
  for (const int stretch : {1, 7, 39, 100}) {
    const Found found = search_roll_outs(halves.clip, absolute_actions(), halves.options, {4, stretch, -0.5});
    ASSERT_EQ(found.options.count(), 39);
    EXPECT_NEAR(found.value,
                search_value(halves.clip, absolute_actions(), halves.options, found.options, -0.5), 1e-12)
        << stretch;
    for (int t = 1; t < 39; ++t)
      EXPECT_TRUE(found.options[t] == found.options[t - 1] || t % stretch == 0) << t;
  }
}

TEST(BeamSearch, FullWidthFindsTheOptimum) {
  constexpr int kFrames = 25, kStretch = 4, kStretches = 6;
  const Halves halves(kFrames);
  double best = 0.0;
  for (int bits = 0; bits < 1 << kStretches; ++bits) {
    List<int> acting;
    for (int t = 0; t < kFrames - 1; ++t) acting.push_back(bits >> (t / kStretch) & 1);
    best = std::max(best, search_value(halves.clip, absolute_actions(), halves.options, acting, -0.25));
  }
  const Found found =
      search_roll_outs(halves.clip, absolute_actions(), halves.options, {1 << kStretches, kStretch, -0.25});
  EXPECT_NEAR(found.value, best, 1e-12);
}

TEST(BeamSearch, DropsFallenPathsWhateverTheirReward) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(60), {});
  const Option falls = constant_option(rl::tracking::kStateSize, 1.5F),
               stands = constant_option(rl::tracking::kStateSize, 0.0F);
  const Found found = search_roll_outs(clip, {}, {&falls, &stands}, {1, 60, 0.0});
  EXPECT_EQ(found.options, List<int>(59, 1));
  EXPECT_TRUE(found.breaks.empty());
}

TEST(BeamSearch, RestartsFromTheReferenceWhereAllPathsFall) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(60), {});
  const Option falls = constant_option(rl::tracking::kStateSize, 1.5F);
  const Found found = search_roll_outs(clip, {}, {&falls}, {3, 20, 0.0});
  EXPECT_EQ(found.options, List<int>(59, 0));
  const auto rolled = rl::tracking::roll_out(
      clip, {}, [](int, const float*, float* action) { std::fill(action, action + kDofs, 1.5F); });
  const auto stands = [&](int t) {
    double worst = 0.0;
    for (int body = 0; body < kBodies; ++body)
      worst = std::max(
          worst, (rolled.poses[static_cast<std::size_t>(t)].p_WB[body] - clip->poses[t].p_WB[body]).norm());
    return worst <= rl::tracking::TrackingConfig{}.terminate_distance;
  };
  int fall = 0;
  while (fall < static_cast<int>(rolled.poses.size()) && stands(fall)) ++fall;
  ASSERT_LT(fall, 20);
  ASSERT_FALSE(found.breaks.empty());
  EXPECT_EQ(found.breaks.front(), fall) << "the frame of the fall, not the end of the stretch";
  for (std::size_t k = 1; k < found.breaks.size(); ++k)
    EXPECT_GT(found.breaks[k], 20 * static_cast<int>(k)) << "it restarts at the ends of stretches";
  EXPECT_GT(found.value, 0.0);
}

/// A trap for whoever looks at rewards alone: feet that push the body over while its arms are right, and arms
/// that are wrong on a body that would stand longer.
struct Trap {
  Trap() {
    const auto turn = [](Option& option, int joint, float angle) {
      option.agent.actor.biases.back()(first_dof(joint)) = angle;
    };
    for (const int ankle : {kLeftAnkle, kRightAnkle}) turn(leans, ankle, 0.4F);
    for (const int elbow : {kLeftElbow, kRightElbow}) turn(stands, elbow, 0.3F);
  }
  Found search(int width, int retries) const {
    return search_roll_outs(clip, {}, {&leans, &stands}, {width, 6, 0.0, retries});
  }
  Clip clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(90), {});
  Option leans = constant_option(rl::tracking::kStateSize, 0.0F), stands = leans;
};

TEST(BeamSearch, RetriesFromEarlierWithMoreStates) {
  const Trap trap;
  EXPECT_FALSE(trap.search(1, 0).breaks.empty()) << "no trap for a narrow beam";
  const Found found = trap.search(1, 3);
  EXPECT_TRUE(found.breaks.empty());
  EXPECT_NEAR(found.value, search_value(trap.clip, {}, {&trap.leans, &trap.stands}, found.options, 0.0),
              1e-12);
}

TEST(BeamSearch, RetriesChangeNothingIfSomePathStands) {
  const Trap trap;
  const Found found = trap.search(16, 3), without = trap.search(16, 0);
  EXPECT_TRUE(without.breaks.empty());
  EXPECT_EQ(found.options, without.options);
  EXPECT_EQ(found.value, without.value);
}

TEST(BeamSearch, FailedRetriesRecordTheBreak) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(60), {});
  const Option falls = constant_option(rl::tracking::kStateSize, 1.5F);
  const Found found = search_roll_outs(clip, {}, {&falls}, {3, 20, 0.0, 2});
  EXPECT_EQ(found.options, List<int>(59, 0));
  EXPECT_FALSE(found.breaks.empty());
  EXPECT_EQ(found.searched, 59);
}

TEST(BeamSearch, TiesGoToTheLowerIndex) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(20), {});
  const Option option = constant_option(rl::tracking::kStateSize, 0.0F);
  EXPECT_EQ(search_roll_outs(clip, {}, {&option, &option, &option}, {2, 5, 0.0}).options, List<int>(19, 0));
}

// Told to stop in the third stretch it has found two, which are those it finds when it is let alone.
TEST(BeamSearch, StopsOnRequest) {
  const Halves halves(40);
  const SearchConfig config{4, 7, -0.5};
  const Found whole = search_roll_outs(halves.clip, absolute_actions(), halves.options, config);
  EXPECT_EQ(whole.searched, 39);
  int asked = 0;
  const Found part =
      search_roll_outs(halves.clip, absolute_actions(), halves.options, config, [&] { return ++asked > 16; });
  EXPECT_EQ(asked, 17) << "once for a frame, and not again";
  EXPECT_EQ(part.searched, 14);
  ASSERT_EQ(part.options.count(), 39);
  for (int t = 14; t < 39; ++t) EXPECT_EQ(part.options[t], part.options[13]) << t;
  const SearchConfig narrow{1, 7, -0.5};  // what a beam of one has kept it does not change any more
  const Found greedy = search_roll_outs(halves.clip, absolute_actions(), halves.options, narrow);
  asked = 0;
  const Found begun =
      search_roll_outs(halves.clip, absolute_actions(), halves.options, narrow, [&] { return ++asked > 16; });
  for (int t = 0; t < 14; ++t) EXPECT_EQ(begun.options[t], greedy.options[t]) << t;
  const Found none =
      search_roll_outs(halves.clip, absolute_actions(), halves.options, config, [] { return true; });
  EXPECT_EQ(none.searched, 0);
  EXPECT_EQ(none.options, List<int>(39, 0));
}

TEST(BeamSearch, RejectsImpossibleSettings) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(5), {});
  const Option option = constant_option(rl::tracking::kStateSize, 0.0F);
  for (const SearchConfig& wrong : {SearchConfig{0, 1, 0.0}, SearchConfig{1, 0, 0.0}, SearchConfig{1, 1, 0.1},
                                    SearchConfig{1, 1, std::nan("")}, SearchConfig{1, 1, 0.0, -1}})
    EXPECT_THROW(search_roll_outs(clip, {}, {&option}, wrong), std::invalid_argument);
  EXPECT_THROW(search_roll_outs(clip, {}, {}, {1, 1, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::pipeline::options
