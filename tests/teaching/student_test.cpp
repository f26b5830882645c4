// A plan teaches a policy that does without it.
#include "teaching/student.h"

#include <gtest/gtest.h>

#include "rl/tracking/tracking_rollout.h"
#include "teaching/taught_motion.h"

namespace mimicx::teaching {
namespace {

StudentConfig quick_student() {
  StudentConfig config;
  config.rounds = 5;
  config.stages = 1;
  config.least_steps = 60;
  config.hidden = 64;
  return config;
}

TEST(Student, FollowsASquatAloneAndUnderPushes) {
  const Teacher& teacher = teacher_of_squat();
  StudentConfig config = quick_student();
  config.rounds = 6;
  config.least_steps = 120;
  const rl::Agent agent = teach_student(teacher, {}, config, {.threads = 2}).value();
  const auto alone = rl::tracking::roll_out(teacher.clip, {}, rl::tracking::mean_action({agent}));
  EXPECT_LT(alone.mean_position_error, 0.01);
  control::PushTest pushes;
  pushes.every = 15;
  EXPECT_GE(test_pushes(teacher.clip, {}, agent, pushes).followed, 14);
}

TEST(Student, ThreadsDoNotChangeABit) {
  const rl::Agent one = teach_student(teacher_of_squat(), {}, quick_student(), {.threads = 1}).value(),
                  two = teach_student(teacher_of_squat(), {}, quick_student(), {.threads = 2}).value();
  for (int layer = 0; layer < one.actor.layers(); ++layer) {
    EXPECT_EQ(one.actor.weights[static_cast<std::size_t>(layer)],
              two.actor.weights[static_cast<std::size_t>(layer)]);
    EXPECT_EQ(one.actor.biases[static_cast<std::size_t>(layer)],
              two.actor.biases[static_cast<std::size_t>(layer)]);
  }
  EXPECT_EQ(one.observations.shift, two.observations.shift);
}

TEST(Student, AnotherSeedGivesAnotherStudent) {
  StudentConfig config = quick_student();
  config.rounds = 1;
  const rl::Agent one = teach_student(teacher_of_squat(), {}, config, {}).value();
  config.seed = 2;
  EXPECT_NE(one.actor.weights[0], teach_student(teacher_of_squat(), {}, config, {}).value().actor.weights[0]);
}

TEST(Student, AddsStagesUntilItFollows) {
  StudentConfig config = quick_student();
  config.rounds = 2;
  config.stages = 3;
  config.step_size = config.last_step_size = 1.0;  // far too large: it learns nonsense, and falls
  int rounds = 0;
  teach_student(teacher_of_squat(), {}, config, {}, [&](const RoundStats&, const rl::Agent&) { ++rounds; });
  EXPECT_EQ(rounds, 6);
}

TEST(Student, IsWiderAfterAFailedFirstStage) {
  StudentConfig config = quick_student();
  config.rounds = 2;
  config.stages = 2;
  config.step_size = config.last_step_size = 1.0;  // far too large: it learns nonsense, and falls
  std::vector<Eigen::Index> widths;
  teach_student(teacher_of_squat(), {}, config, {}, [&](const RoundStats&, const rl::Agent& agent) {
    widths.push_back(agent.actor.weights[0].cols());
  });
  EXPECT_EQ(widths, (std::vector<Eigen::Index>{64, 64, 128, 128}));
}

TEST(Student, KeepsAtMostTheConfiguredLessons) {
  StudentConfig config = quick_student();
  config.rounds = 3;
  config.most_rows = 100;
  int taken = 0;
  EXPECT_TRUE(teach_student(teacher_of_squat(), {}, config, {},
                            [&](const RoundStats& stats, const rl::Agent&) { taken = stats.taken; }));
  EXPECT_EQ(taken, 3 * config.packs * physics::kLanes * teacher_of_squat().size());
}

TEST(Student, StopsOnRequest) {
  control::PlanControl control;
  int asked = 0;
  control.should_stop = [&] { return ++asked > 10; };
  EXPECT_FALSE(teach_student(teacher_of_squat(), {}, quick_student(), control));
}

}  // namespace
}  // namespace mimicx::teaching
