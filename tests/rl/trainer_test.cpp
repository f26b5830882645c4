#include "rl/trainer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rl/ppo_fixture.h"
#include "rl/toy_environments.h"

namespace mimicx::rl {
namespace {

using toy::DoubleIntegrator;
using toy::ToyEnvironment;
using Trainer = PpoTrainer<toy::ToyEnvironment<toy::DoubleIntegrator>>;

constexpr Course kCourse = {.seed = 1, .falling_samples = 2'000'000};

Npz state_of(const Trainer& trainer) {
  Npz archive;
  trainer.save(archive, "t.");
  return archive;
}

TEST(Trainer, IsBitIdenticalForOneAndTwoThreads) {
  toy::ToyEnvironment<toy::DoubleIntegrator> one(5, 12, 1), two(5, 12, 1);
  Trainer first(small_config(), kCourse, {small_agent()}, one),
      second(small_config(), kCourse, {small_agent()}, two);
  for (int k = 0; k < 6; ++k) {
    const IterationStats a = first.iterate(1), b = second.iterate(2);
    EXPECT_EQ(a.kl, b.kl);
    EXPECT_EQ(a.mean_reward, b.mean_reward);
    EXPECT_EQ(a.minibatches > 0, k > 0);
  }
  expect_same_bytes(state_of(first), state_of(second));
}

TEST(Trainer, ResumedTrainingGivesTheBytesOfAnUninterruptedOne) {
  toy::ToyEnvironment<toy::DoubleIntegrator> whole_world(4, 16, 2), first_world(4, 16, 2),
      second_world(4, 16, 99);
  Trainer whole(small_config(), kCourse, {small_agent()}, whole_world);
  Trainer first(small_config(), kCourse, {small_agent()}, first_world);
  for (int k = 0; k < 3; ++k) {
    whole.iterate(2);
    first.iterate(2);
  }
  PpoConfig other = small_config();
  other.step_size *= 7.0;  // the checkpoint must override this step size
  Trainer resumed(other, kCourse, {small_agent()}, second_world);
  // The environment's random numbers are keyed by its seed, which is part of the configuration.
  second_world = toy::ToyEnvironment<toy::DoubleIntegrator>(4, 16, 2);
  resumed.load(state_of(first), "t.");
  for (int k = 0; k < 4; ++k) {
    const IterationStats expected = whole.iterate(2), found = resumed.iterate(2);
    EXPECT_EQ(found.mean_episode_length, expected.mean_episode_length);
    EXPECT_EQ(found.samples, expected.samples);
    EXPECT_EQ(found.kl, expected.kl);
  }
  expect_same_bytes(state_of(whole), state_of(resumed));
}

TEST(Trainer, TrainsWithTheConfigurationAsConstructed) {
  ToyEnvironment<DoubleIntegrator> world(4, 16, 1);
  Trainer trainer(PpoConfig{}, kCourse, {small_agent()}, world);
  trainer.iterate(1);
  const IterationStats stats = trainer.iterate(1);
  EXPECT_EQ(stats.samples, 2 * 4 * 16 * PpoConfig{}.horizon);
  EXPECT_GT(stats.minibatches, 0);
  for (const double number :
       {stats.mean_reward, stats.policy_loss, stats.value_loss, stats.kl, stats.actor_gradient})
    EXPECT_TRUE(std::isfinite(number));
  EXPECT_GT(stats.actor_gradient, 0.0);
}

TEST(Trainer, LoadRejectsAnotherNumberOfCharacters) {
  toy::ToyEnvironment<toy::DoubleIntegrator> small(2, 8, 1), large(3, 8, 1);
  Trainer a(small_config(), kCourse, {small_agent()}, small),
      b(small_config(), kCourse, {small_agent()}, large);
  EXPECT_THROW(b.load(state_of(a), "t."), DataError);
}

TEST(Trainer, RejectsAWrongNumberOfAgents) {
  toy::ToyEnvironment<toy::DoubleIntegrator> world(2, 8, 1);
  EXPECT_THROW(Trainer(small_config(), kCourse, {}, world), std::invalid_argument);
  EXPECT_THROW(Trainer(small_config(), kCourse, {small_agent(), small_agent()}, world),
               std::invalid_argument);
}

/// The archive without the member, or with the member emptied.
Npz damaged(const Npz& whole, const std::string& key, bool emptied) {
  Npz archive;
  archive.path = "damaged.npz";
  for (const auto& [name, array] : whole.members()) {
    if (name != key) archive.set(name, array);
    if (name != key || !emptied) continue;
    NpyArray nothing;
    nothing.type = array.type;
    nothing.shape = {0};
    archive.set(name, nothing);
  }
  return archive;
}

TEST(Trainer, RejectsIncompleteCheckpoints) {
  toy::ToyEnvironment<toy::DoubleIntegrator> world(2, 8, 1);
  Trainer trainer(small_config(), kCourse, {small_agent()}, world);
  for (int k = 0; k < 2; ++k) trainer.iterate(1);
  const Npz whole = state_of(trainer);
  for (const auto& [key, array] : whole.members())
    for (const bool emptied : {false, true})
      EXPECT_THROW(trainer.load(damaged(whole, key, emptied), "t."), DataError) << key << ' ' << emptied;
  trainer.load(whole, "t.");
}

/// Every episode ends at its third step. Between two roll-outs all characters are reset to new episodes.
struct ThreeSteps : toy::ToyEnvironment<toy::DoubleIntegrator> {
  using toy::ToyEnvironment<toy::DoubleIntegrator>::ToyEnvironment;
  std::vector<int> ages = std::vector<int>(8, 0);

  void step(int group, const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result) {
    TaskEnvironment::step(group, actions, result);
    for (int i = 0; i < group_size(); ++i) {
      int& age = ages[static_cast<std::size_t>(i)];
      result.truncated[i] = false;
      result.terminated[i] = ++age == 3;
      if (result.terminated[i]) age = 0;
    }
  }
  std::vector<CharacterPlace> end_iteration() {
    std::vector<CharacterPlace> restarted;
    for (int i = 0; i < group_size(); ++i) restarted.push_back({0, i});
    ages.assign(8, 0);
    return restarted;
  }
};

TEST(Trainer, EpisodesEndedByTheEnvironmentRestartTheirAge) {
  ThreeSteps world(1, 8, 1);
  PpoConfig config = small_config();
  config.horizon = 4;
  PpoTrainer<ThreeSteps> trainer(config, kCourse, {small_agent()}, world);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(trainer.iterate(1).mean_episode_length, 3.0) << k;
}

TEST(Trainer, NoiseNeverRepeatsBetweenGroupsIterationsAndSeeds) {
  const auto noise = [](const Trainer& trainer, int group) {
    const GroupRollout& g = trainer.buffer().groups[group];
    return nn::Matrix<float>(g.actions - g.means);
  };
  toy::ToyEnvironment<toy::DoubleIntegrator> world(2, 8, 1), other_world(2, 8, 1);
  Course other_course = kCourse;
  ++other_course.seed;
  Trainer trainer(small_config(), kCourse, {small_agent()}, world),
      other(small_config(), other_course, {small_agent()}, other_world);
  trainer.iterate(1);
  other.iterate(1);
  const nn::Matrix<float> first = noise(trainer, 0), beside = noise(trainer, 1), elsewhere = noise(other, 0);
  trainer.iterate(1);
  for (const nn::Matrix<float>& m : {beside, elsewhere, noise(trainer, 0)})
    EXPECT_GT((m - first).cwiseAbs().minCoeff(), 0.0F);
}

TEST(Trainer, NormaliserAbsorbsTheObservationsAfterTheRollOut) {
  toy::ToyEnvironment<toy::DoubleIntegrator> world(2, 8, 1);
  Trainer trainer(small_config(), kCourse, {small_agent()}, world);
  for (int k = 0; k < 3; ++k) trainer.iterate(2);
  EXPECT_EQ(trainer.learner().agent.observations.moments.count, 3 * trainer.buffer().rows());
  EXPECT_EQ(trainer.learner().samples, 3 * trainer.buffer().rows());
}

}  // namespace
}  // namespace mimicx::rl
