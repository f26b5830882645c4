#include "pipeline/options/option.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/options/constant_option.h"
#include "pipeline/options/side_by_side.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {
namespace {

TEST(EncodedState, ThePolicySeesTheReferenceOnlyThroughItsEncoder) {
  rl::tracking::TrackingConfig config;
  const motion::Reference reference = rl::tracking::swaying_reference(20);
  const auto plain = rl::tracking::make_tracking_clip(reference, config);
  Option option = constant_option(rl::tracking::kEncodedRest + 8, 0.0F);
  option.encoder = some_encoder(*plain);
  const auto seen = encoded_for(plain, {&option});
  EXPECT_EQ(seen->state_size(), rl::tracking::kEncodedRest + 8);
  // Another reference with the same codes and the same root position: nothing else of it may be visible.
  auto other = std::make_shared<rl::tracking::TrackingClip>(*seen);
  for (rl::tracking::Pose& pose : other->poses)
    pose.frame.q[kLeftShoulder] = exp_map(Vector3d(0.4, 0.2, 0.1));
  std::vector<float> a(static_cast<std::size_t>(seen->state_size())), b = a;
  rl::tracking::TrackingPack first(seen, config), second(other, config);
  second.copy_lane(0, first, 0);
  first.observe(0, a.data());
  second.observe(0, b.data());
  EXPECT_EQ(a, b);
}

TEST(Option, EitherAllHaveAnEncoderOrNone) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(10), {});
  Option with = constant_option(rl::tracking::kEncodedRest + 8, 0.0F),
         without = constant_option(rl::tracking::kStateSize, 0.0F);
  with.encoder = some_encoder(*clip);
  EXPECT_THROW(encoded_for(clip, {&with, &without}), std::invalid_argument);
  EXPECT_EQ(encoded_for(clip, {&without, &without}), clip);
}

TEST(Option, ComeBackFromAnArchiveToTheBit) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(10), {});
  Option option = constant_option(rl::tracking::kEncodedRest + 8, 0.1F);
  option.encoder = some_encoder(*clip);
  Npz archive;
  save(archive, "o.", option);
  const Option back = load_option(archive, "o.");
  EXPECT_TRUE(back.agent.actor.biases.back() == option.agent.actor.biases.back());
  EXPECT_EQ(encoded_for(clip, {&back})->encoded[0].codes, encoded_for(clip, {&option})->encoded[0].codes);
}

TEST(SideBySide, WhoFailsTakesOverTheStateOfTheBest) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option good = constant_option(rl::tracking::kStateSize, 0.0F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide result = roll_out_side_by_side(clip, {}, {&bad, &good, &bad}, 0.3);
  const SideBySide alone = roll_out_side_by_side(clip, {}, {&good}, 0.3);
  ASSERT_EQ(result.rewards.size(), 30U);
  EXPECT_TRUE(result.breaks.empty());
  for (std::size_t t = 1; t < 30; ++t) {
    EXPECT_EQ(result.rewards[t][1], alone.rewards[t][0]) << "others do not disturb the good one";
    EXPECT_EQ(result.rewards[t][0], result.rewards[t][2]) << "equals stay equal";
  }
  // From the same state the bad option is bad at once or next: it has been put back many times.
  int under = 0;
  for (std::size_t t = 1; t < 30; ++t) under += result.rewards[t][0] < 0.3 ? 1 : 0;
  EXPECT_GE(under, 5);
}

TEST(SideBySide, WhereAllFailTheyRestartFromTheReference) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide result = roll_out_side_by_side(clip, {}, {&bad, &bad}, 0.3);
  ASSERT_GE(result.breaks.size(), 2U);
  std::array<float, kDofs> action;
  action.fill(1.5F);
  for (const int t : result.breaks) {
    if (t + 1 >= clip->size()) continue;
    rl::tracking::TrackingPack fresh(clip, {});
    fresh.reset(0, t);
    fresh.act(0, action.data());
    physics::Data<rl::tracking::TrackingPack::P> scratch;
    fresh.advance(scratch);
    EXPECT_EQ(result.rewards[static_cast<std::size_t>(t) + 1][0], fresh.reward(0).total);
  }
}

}  // namespace
}  // namespace mimicx::pipeline::options
