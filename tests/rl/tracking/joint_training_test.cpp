/// Several options that learn on one clip, each where the arrangement has it act.
#include <gtest/gtest.h>

#include "rl/ppo_fixture.h"
#include "rl/tracking/tracking_environment.h"
#include "rl/tracking/tracking_fixture.h"
#include "rl/trainer.h"

namespace mimicx::rl::tracking {
namespace {

constexpr Course kCourse = {.seed = 1, .falling_samples = 2'000'000};

/// One clip whose two halves belong to two options.
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
