#include "pipeline/options/option.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/options/constant_option.h"
#include "pipeline/options/option_rewards.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {
namespace {

TEST(EncodedState, PolicySeesTheReferenceOnlyThroughItsEncoder) {
  rl::tracking::TrackingConfig config;
  const motion::Reference reference = rl::tracking::swaying_reference(20);
  const auto plain = rl::tracking::make_tracking_clip(reference, config);
  Option option = constant_option(rl::tracking::kEncodedRest + 8, 0.0F);
  option.encoder = some_encoder(*plain);
  const auto seen = encoded_for(plain, {&option});
  EXPECT_EQ(seen->state_size(), rl::tracking::kEncodedRest + 8);
  // Another reference with the same codes, the same root position and the same heading, in which codes are
  // turned: nothing else of it may be visible.
  auto other = std::make_shared<rl::tracking::TrackingClip>(*seen);
  Random random(3);
  for (rl::tracking::Pose& pose : other->poses) {
    motion::ReferenceFrame frame = rl::tracking::random_frame(random, 0.4);
    frame.p_root = pose.frame.p_root;
    const Eigen::Vector2d was = rl::tracking::heading_direction(pose.frame.q[0]),
                          is = rl::tracking::heading_direction(frame.q[0]);
    frame.q[0] = rotation_z(std::atan2(was.y(), was.x()) - std::atan2(is.y(), is.x())) * frame.q[0];
    pose = rl::tracking::pose_of(reference.character, frame);
  }
  for (std::size_t t = 0; t < other->joints.size(); ++t)
    other->joints[t] = rl::tracking::joint_features(other->poses[t].frame);
  std::vector<float> a(static_cast<std::size_t>(seen->state_size())), b = a;
  rl::tracking::TrackingPack first(seen, config), second(other, config);
  second.copy_lane(0, first, 0);
  first.observe(0, a.data());
  second.observe(0, b.data());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-5) << k;
}

TEST(Option, AllOrNoneHaveAnEncoder) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(10), {});
  Option with = constant_option(rl::tracking::kEncodedRest + 8, 0.0F),
         without = constant_option(rl::tracking::kStateSize, 0.0F);
  with.encoder = some_encoder(*clip);
  EXPECT_THROW(encoded_for(clip, {&with, &without}), std::invalid_argument);
  EXPECT_EQ(encoded_for(clip, {&without, &without}), clip);
}

TEST(Option, RoundTripIsExact) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(10), {});
  Option option = constant_option(rl::tracking::kEncodedRest + 8, 0.1F);
  option.encoder = some_encoder(*clip);
  Npz archive;
  save(archive, "o.", option);
  const Option back = load_option(archive, "o.");
  EXPECT_TRUE(back.agent.actor.biases.back() == option.agent.actor.biases.back());
  EXPECT_EQ(encoded_for(clip, {&back})->encoded[0].codes, encoded_for(clip, {&option})->encoded[0].codes);
}

TEST(OptionRewards, FailingCharacterTakesTheBestOnesState) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option good = constant_option(rl::tracking::kStateSize, 0.0F),
               bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide result = roll_out_side_by_side(clip, {}, {&bad, &good, &bad}, {0.3});
  const SideBySide alone = roll_out_side_by_side(clip, {}, {&good}, {0.3});
  ASSERT_EQ(result.rewards.size(), 30U);
  EXPECT_TRUE(result.breaks.empty());
  for (std::size_t t = 1; t < 30; ++t) {
    EXPECT_EQ(result.rewards[t][1], alone.rewards[t][0]) << "others do not disturb the good one";
    EXPECT_EQ(result.rewards[t][0], result.rewards[t][2]) << "equals stay equal";
  }
  // Both in one pack: whenever the bad one fails, it goes on from where the good one stands.
  rl::tracking::TrackingPack pack(clip, {});
  physics::Data<rl::tracking::TrackingPack::P> scratch;
  for (int lane = 0; lane < physics::kLanes; ++lane) pack.reset(lane, 0);
  std::array<float, kDofs> still{}, bent{};
  bent.fill(1.5F);
  int rescues = 0;
  for (std::size_t t = 1; t < 30; ++t) {
    pack.act(0, still.data());
    pack.act(1, bent.data());
    pack.advance(scratch);
    const bool fell = !(pack.worst_distance(1) <= RescueBounds{}.distance);
    const double reward = fell ? 0.0 : pack.reward(1).total;
    EXPECT_EQ(result.rewards[t][0], reward) << t;
    EXPECT_EQ(result.rescued[t][0], reward < 0.3) << t;
    if (reward >= 0.3) continue;
    EXPECT_LT(pack.reward(0).total, 1.0) << "the good one's state is not the reference's";
    pack.copy_lane(1, pack, 0);
    ++rescues;
  }
  EXPECT_GE(rescues, 5);
}

TEST(OptionRewards, AllRestartFromTheReferenceWhereAllFail) {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(30), {});
  const Option bad = constant_option(rl::tracking::kStateSize, 1.5F);
  const SideBySide result = roll_out_side_by_side(clip, {}, {&bad, &bad}, {0.3});
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
