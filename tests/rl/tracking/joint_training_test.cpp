/// Several options that learn on one clip, each at the frames that the arrangement gives it.
#include <gtest/gtest.h>

#include "rl/ppo_fixture.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/trainer.h"

namespace mimicx::rl::tracking {
namespace {

constexpr Course kCourse = {.seed = 1, .falling_samples = 2'000'000};

/// A clip with one option in each half.
std::shared_ptr<const TrackingClip> halved_clip(int frames) {
  auto clip = std::make_shared<TrackingClip>(*make_tracking_clip(swaying_reference(frames), {}));
  for (int t = 0; t < frames; ++t) clip->arrangement.push_back(t < frames / 2 ? 0 : 1);
  return clip;
}

TEST(JointTraining, EveryFrameIsValuedByTheCriticOfTheOptionThatActsThere) {
  TrackingEnvironment environment({halved_clip(24)}, {}, 2 * physics::kLanes, physics::kLanes, 5);
  List<Agent> agents(2, agent_that_does(0.0F));
  const float value[] = {3.0F, 11.0F};
  for (int k = 0; k < 2; ++k) {
    agents[k].critic.weights.back().setZero();
    agents[k].critic.biases.back().setConstant(value[k]);
  }
  PpoConfig config = ppo_for_tests();
  config.horizon = 40;
  PpoTrainer<TrackingEnvironment> trainer(config, kCourse, agents, environment);
  trainer.iterate(2);
  Array<int, 2> rows{}, bootstraps{};
  for (const GroupRollout& group : trainer.buffer().groups) {
    for (std::size_t row = 0; row < group.actors.size(); ++row) {
      const int actor = group.actors[row];
      EXPECT_EQ(group.values.data()[row], value[actor]);
      ++rows[actor];
      // The clip ends in the second option's half: its critic gives the value of the final observation.
      if (group.truncated.data()[row]) {
        EXPECT_EQ(group.final_values.data()[row], value[1]);
        ++bootstraps[1];
      }
    }
  }
  for (int g = 0; g < trainer.buffer().groups.count(); ++g)
    for (int i = 0; i < trainer.buffer().group_size; ++i)
      EXPECT_EQ(trainer.buffer().groups[g].last_values(0, i), value[environment.actor(g, i)]);
  EXPECT_GT(rows[0], 0);
  EXPECT_GT(rows[1], 0);
  EXPECT_GT(bootstraps[1], 0);
}

// A_t is the sum of (γλ)ᵏ δ_{t+k} up to the episode's end; critics that say the same of every state make each
// δ known.
TEST(JointTraining, ReturnsAcrossASwitchUseTheNextOptionsCritic) {
  TrackingEnvironment environment({halved_clip(24)}, {}, 2 * physics::kLanes, physics::kLanes, 5);
  List<Agent> agents(2, agent_that_does(0.0F));
  const double value[] = {3.0, 11.0};
  for (int k = 0; k < 2; ++k) {
    agents[k].critic.weights.back().setZero();
    agents[k].critic.biases.back().setConstant(static_cast<float>(value[k]));
  }
  PpoConfig config = ppo_for_tests();
  config.horizon = 40;
  PpoTrainer<TrackingEnvironment> trainer(config, kCourse, agents, environment);
  trainer.iterate(2);
  const int width = trainer.buffer().group_size;
  int switches = 0;
  for (int g = 0; g < trainer.buffer().groups.count(); ++g) {
    const GroupRollout& group = trainer.buffer().groups[g];
    const auto actor = [&](int t, int i) {
      return t < config.horizon ? group.actors[static_cast<std::size_t>(t * width + i)]
                                : environment.actor(g, i);
    };
    for (int i = 0; i < width; ++i)
      for (int first = 0; first < config.horizon; ++first) {
        double sum = 0.0, weight = 1.0;
        for (int t = first; t < config.horizon; ++t, weight *= config.gamma * config.lambda) {
          const bool fell = group.terminated(t, i), ended = group.truncated(t, i);
          const double next = fell    ? 0.0
                              : ended ? value[1]
                                      : value[actor(t + 1, i)];  // the clip ends in option 1
          sum += weight * (group.rewards(t, i) + config.gamma * next - value[actor(t, i)]);
          if (fell || ended) break;
          switches += t == first && actor(t, i) != actor(t + 1, i);
        }
        EXPECT_NEAR(group.advantages(first, i), sum, 1e-4);
      }
  }
  EXPECT_GT(switches, 0);
}

TEST(JointTraining, OptionsLearnFromTheirOwnFramesOnly) {
  // Option 1 acts at every frame, option 0 never.
  auto clip = std::make_shared<TrackingClip>(*make_tracking_clip(swaying_reference(24), {}));
  clip->arrangement.assign(24, 1);
  TrackingEnvironment environment({clip}, {}, 2 * physics::kLanes, physics::kLanes, 5);
  const Agent start = agent_that_does(0.0F);
  PpoConfig config = ppo_for_tests();
  config.horizon = 16;
  config.minibatch = 128;
  PpoTrainer<TrackingEnvironment> trainer(config, kCourse, {start, start}, environment);
  for (int k = 0; k < 3; ++k) trainer.iterate(2);
  EXPECT_TRUE(trainer.learners()[0].agent.actor.weights[0] == start.actor.weights[0]);
  EXPECT_FALSE(trainer.learners()[1].agent.actor.weights[0] == start.actor.weights[0]);
  EXPECT_EQ(trainer.learners()[0].samples, 0);
  EXPECT_EQ(trainer.learners()[1].samples, trainer.samples());
}

TEST(JointTraining, IsBitIdenticalForOneAndTwoThreadsAndAfterSaveAndLoad) {
  PpoConfig config = ppo_for_tests();
  config.horizon = 16;
  config.minibatch = 128;
  const Agent start = agent_that_does(0.0F);
  const auto make_environment = [] {
    return TrackingEnvironment({halved_clip(24)}, {}, 2 * physics::kLanes, physics::kLanes, 5);
  };
  TrackingEnvironment one = make_environment(), two = make_environment(), later = make_environment();
  PpoTrainer<TrackingEnvironment> first(config, kCourse, {start, start}, one),
      second(config, kCourse, {start, start}, two), resumed(config, kCourse, {start, start}, later);
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

}  // namespace
}  // namespace mimicx::rl::tracking
