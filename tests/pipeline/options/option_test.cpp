#include "pipeline/options/option.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/options/constant_option.h"
#include "pipeline/options/side_by_side.h"
#include "rl/tracking/environment.h"
#include "rl/tracking/rollout.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/trainer.h"

namespace mimicx::rl {
namespace {

TEST(EncodedState, TurningFeaturesIsSeeingThemFromAnotherHeading) {
  const Character character = make_character();
  Random random(21);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = pose_of(character, random_frame(random, 0.4));
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3);
    const Eigen::Vector2d from(std::cos(a), std::sin(a)), to(std::cos(b), std::sin(b));
    std::array<float, kPoseFeatures> seen_from{}, seen_to{}, turned{};
    pose_features(pose, joint_features(pose.frame), from, seen_from.data());
    pose_features(pose, joint_features(pose.frame), to, seen_to.data());
    turn_features(seen_from.data(), from, to, turned.data());
    for (std::size_t k = 0; k < kPoseFeatures; ++k) EXPECT_NEAR(turned[k], seen_to[k], 2e-5) << k;
  }
}

TEST(EncodedState, WithAPerfectDecoderItIsTheRawStateWithACodeForThePose) {
  const Character character = make_character();
  Random random(22);
  const Pose reference = pose_of(character, random_frame(random, 0.3)),
             simulated = pose_of(character, random_frame(random, 0.3));
  std::array<float, kStateSize> raw{};
  tracking_state(reference, joint_features(reference.frame), {0.5}, simulated, raw.data());
  std::array<float, kPoseFeatures> decoded{};
  own_pose_features(reference, decoded.data());
  const float code[] = {1.0F, 2.0F, 3.0F};
  std::array<float, kEncodedRest + 4> state{};
  state.back() = -7.0F;
  encoded_state(code, 3, decoded, reference, {0.5}, simulated, state.data());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(state[k], code[k]);
  for (std::size_t k = 0; k < kEncodedRest; ++k) EXPECT_NEAR(state[3 + k], raw[kPoseFeatures + k], 2e-5) << k;
  EXPECT_EQ(state.back(), -7.0F) << "wrote past its end";
}

TEST(EncodedState, ThePolicySeesTheReferenceOnlyThroughItsEncoder) {
  TrackingConfig config;
  const Reference reference = swaying_reference(20);
  const auto plain = make_tracking_clip(reference, config);
  Option option = constant_option(kEncodedRest + 8, 0.0F);
  option.encoder = some_encoder(*plain);
  const auto seen = encoded_for(plain, {&option});
  EXPECT_EQ(seen->state_size(), kEncodedRest + 8);
  // Another reference with the same codes and the same root position: nothing else of it may be visible.
  auto other = std::make_shared<TrackingClip>(*seen);
  for (Pose& pose : other->poses) pose.frame.q[kLeftShoulder] = exp_map(Vector3d(0.4, 0.2, 0.1));
  std::vector<float> a(static_cast<std::size_t>(seen->state_size())), b = a;
  TrackingPack first(seen, config), second(other, config);
  second.copy_lane(0, first, 0);
  first.observe(0, a.data());
  second.observe(0, b.data());
  EXPECT_EQ(a, b);
}

TEST(Option, EitherAllHaveAnEncoderOrNone) {
  const auto clip = make_tracking_clip(swaying_reference(10), {});
  Option with = constant_option(kEncodedRest + 8, 0.0F), without = constant_option(kStateSize, 0.0F);
  with.encoder = some_encoder(*clip);
  EXPECT_THROW(encoded_for(clip, {&with, &without}), std::invalid_argument);
  EXPECT_EQ(encoded_for(clip, {&without, &without}), clip);
}

TEST(Option, ComeBackFromAnArchiveToTheBit) {
  const auto clip = make_tracking_clip(swaying_reference(10), {});
  Option option = constant_option(kEncodedRest + 8, 0.1F);
  option.encoder = some_encoder(*clip);
  Npz archive;
  save(archive, "o.", option);
  const Option back = load_option(archive, "o.");
  EXPECT_TRUE(back.agent.actor.biases.back() == option.agent.actor.biases.back());
  EXPECT_EQ(encoded_for(clip, {&back})->encoded[0].codes, encoded_for(clip, {&option})->encoded[0].codes);
}

TEST(SideBySide, WhoFailsTakesOverTheStateOfTheBest) {
  const auto clip = make_tracking_clip(swaying_reference(30), {});
  const Option good = constant_option(kStateSize, 0.0F), bad = constant_option(kStateSize, 1.5F);
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
  const auto clip = make_tracking_clip(swaying_reference(30), {});
  const Option bad = constant_option(kStateSize, 1.5F);
  const SideBySide result = roll_out_side_by_side(clip, {}, {&bad, &bad}, 0.3);
  ASSERT_GE(result.breaks.size(), 2U);
  std::array<float, kDofs> action;
  action.fill(1.5F);
  for (const int t : result.breaks) {
    if (t + 1 >= clip->size()) continue;
    TrackingPack fresh(clip, {});
    fresh.reset(0, t);
    fresh.act(0, action.data());
    Data<TrackingPack::P> scratch;
    fresh.advance(scratch);
    EXPECT_EQ(result.rewards[static_cast<std::size_t>(t) + 1][0], fresh.reward(0).total);
  }
}

TEST(TrackingEnvironment, EveryClipHasItsTurnWhereThereAreMoreThanPacks) {
  TrackingConfig config;
  std::vector<std::shared_ptr<const TrackingClip>> clips;
  for (int k = 0; k < 5; ++k) clips.push_back(make_tracking_clip(swaying_reference(20 + k), config));
  TrackingEnvironment environment(clips, config, 2 * kLanes, kLanes, 3);
  std::vector<std::int64_t> visits(5, 0);
  StepResult result(kLanes, kStateSize);
  for (int iteration = 0; iteration < 64; ++iteration) {
    for (int g = 0; g < 2; ++g) environment.step(g, nn::Matrix<float>::Zero(kLanes, kDofs), result);
    environment.end_iteration();
    for (std::size_t c = 0; c < 5; ++c)
      for (const std::int64_t n : environment.statistics().visits[c]) visits[c] += n;
  }
  for (std::size_t c = 0; c < 5; ++c) EXPECT_GE(visits[c], 16 * kLanes) << "clip " << c;
}

/// One clip whose two halves belong to two options.
std::shared_ptr<const TrackingClip> halved_clip(int frames) {
  auto clip = std::make_shared<TrackingClip>(*make_tracking_clip(swaying_reference(frames), {}));
  for (int t = 0; t < frames; ++t) clip->arrangement.push_back(t < frames / 2 ? 0 : 1);
  return clip;
}

TEST(JointTraining, EveryFrameIsValuedByTheCriticOfTheOptionThatActsThere) {
  TrackingEnvironment environment({halved_clip(24)}, {}, 2 * kLanes, kLanes, 5);
  std::vector<Agent> agents(2, constant_option(kStateSize, 0.0F).agent);
  const float value[] = {3.0F, 11.0F};
  for (std::size_t k = 0; k < 2; ++k) {
    agents[k].critic.weights.back().setZero();
    agents[k].critic.biases.back().setConstant(value[k]);
  }
  PpoConfig config;
  config.horizon = 40;
  PpoTrainer<TrackingEnvironment> trainer(config, agents, environment);
  trainer.iterate(2);
  std::array<int, 2> rows{}, bootstraps{};
  for (const GroupRollout& group : trainer.buffer().groups) {
    for (std::size_t row = 0; row < group.actors.size(); ++row) {
      const auto actor = static_cast<std::size_t>(group.actors[row]);
      EXPECT_EQ(group.values.data()[row], value[actor]);
      ++rows[actor];
      // The clip ends in the second option's half: its critic values what would have come.
      if (group.truncated.data()[row]) {
        EXPECT_EQ(group.final_values.data()[row], value[1]);
        ++bootstraps[1];
      }
    }
    for (Eigen::Index i = 0; i < group.last_values.size(); ++i)
      EXPECT_TRUE(group.last_values(0, i) == value[0] || group.last_values(0, i) == value[1]);
  }
  EXPECT_GT(rows[0], 0);
  EXPECT_GT(rows[1], 0);
  EXPECT_GT(bootstraps[1], 0);
}

TEST(JointTraining, AnOptionLearnsFromItsOwnFramesAlone) {
  // Everything belongs to option 1; option 0 is there and never acts.
  auto clip = std::make_shared<TrackingClip>(*make_tracking_clip(swaying_reference(24), {}));
  clip->arrangement.assign(24, 1);
  TrackingEnvironment environment({clip}, {}, 2 * kLanes, kLanes, 5);
  const Agent start = constant_option(kStateSize, 0.0F).agent;
  PpoConfig config;
  config.horizon = 16;
  config.minibatch = 128;
  PpoTrainer<TrackingEnvironment> trainer(config, {start, start}, environment);
  for (int k = 0; k < 3; ++k) trainer.iterate(2);
  EXPECT_TRUE(trainer.learners()[0].agent.actor.weights[0] == start.actor.weights[0]);
  EXPECT_FALSE(trainer.learners()[1].agent.actor.weights[0] == start.actor.weights[0]);
  EXPECT_EQ(trainer.learners()[0].samples, 0);
  EXPECT_EQ(trainer.learners()[1].samples, trainer.samples());
}

TEST(JointTraining, IsBitIdenticalForOneAndTwoThreadsAndAfterSaveAndLoad) {
  PpoConfig config;
  config.horizon = 16;
  config.minibatch = 128;
  const Agent start = constant_option(kStateSize, 0.0F).agent;
  const auto make_environment = [] {
    return TrackingEnvironment({halved_clip(24)}, {}, 2 * kLanes, kLanes, 5);
  };
  TrackingEnvironment one = make_environment(), two = make_environment(), later = make_environment();
  PpoTrainer<TrackingEnvironment> first(config, {start, start}, one), second(config, {start, start}, two),
      resumed(config, {start, start}, later);
  for (int k = 0; k < 4; ++k) {
    if (k == 2) {
      Npz archive;
      second.save(archive, "t.");
      resumed.load(archive, "t.");
    }
    first.iterate(1);
    second.iterate(2);
  }
  for (int k = 0; k < 2; ++k) resumed.iterate(2);
  for (std::size_t k = 0; k < 2; ++k) {
    const Agent &a = first.learners()[k].agent, &b = second.learners()[k].agent,
                &c = resumed.learners()[k].agent;
    EXPECT_TRUE(a.actor.weights[0] == b.actor.weights[0] && a.critic.weights[0] == b.critic.weights[0]);
    EXPECT_TRUE(a.actor.weights[0] == c.actor.weights[0] && a.critic.weights[0] == c.critic.weights[0]);
  }
}

TEST(TrackingEnvironment, SoftensTheRewardOfAHardMotionAndSharpensItAgain) {
  TrackingConfig config;
  config.reward_target = 0.999;  // nothing is good enough
  TrackingEnvironment hard({make_tracking_clip(swaying_reference(24), config)}, config, kLanes, kLanes, 5);
  StepResult result(kLanes, kStateSize);
  for (int k = 0; k < 20; ++k) {
    hard.step(0, nn::Matrix<float>::Constant(kLanes, kDofs, 0.05F), result);
    hard.end_iteration();
  }
  EXPECT_NEAR(hard.sharpness(), std::pow(1.01, -20), 1e-12);
  EXPECT_GT(hard.statistics().learned_reward, hard.statistics().reward);
  config.reward_target = 0.01;  // everything is
  TrackingEnvironment easy({make_tracking_clip(swaying_reference(24), config)}, config, kLanes, kLanes, 5);
  Npz archive;
  hard.save(archive, "e.");
  easy.load(archive, "e.");
  for (int k = 0; k < 30; ++k) {
    easy.step(0, nn::Matrix<float>::Zero(kLanes, kDofs), result);
    easy.end_iteration();
  }
  EXPECT_EQ(easy.sharpness(), 1.0);
}

}  // namespace
}  // namespace mimicx::rl
