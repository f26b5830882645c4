// What is written down in lessons, and how pushes are counted.
#include "teaching/lessons.h"

#include <gtest/gtest.h>

#include "rl/tracking/mirror.h"
#include "teaching/taught_motion.h"

namespace mimicx::teaching {
namespace {

using physics::kLanes;

/// A student that has learned nothing; unlike those of a new agent its actions are large.
rl::Agent clumsy_student() {
  rl::AgentShape shape;
  shape.observation_dim = rl::tracking::kStateSize;
  shape.action_dim = kDofs;
  shape.hidden = {16};
  shape.last_scale = 1.0f;
  return rl::make_agent(shape, 3);
}

std::span<const float> state_of(const Lessons& lessons, int row) {
  return {lessons.states.data() + row * rl::tracking::kStateSize, rl::tracking::kStateSize};
}

TEST(Lessons, FirstLaneFollowsTheMotionUndisturbed) {
  const Teacher& teacher = teacher_of_squat();
  const Lessons lessons = take_lessons(teacher, {}, {}, nullptr, {1, 0});
  ASSERT_EQ(lessons.rows(), teacher.size() * kLanes);
  for (int t = 0; t < teacher.size(); ++t) {
    const int row = t * kLanes;
    EXPECT_EQ(lessons.weighed_by[row], t);
    for (int k = 0; k < kDofs; ++k)
      EXPECT_NEAR(lessons.actions[row * kDofs + k], teacher.motion.u[t][k], 1e-3f) << t << ' ' << k;
  }
}

TEST(Lessons, LanesAreEqualWithoutDisturbance) {
  LessonConfig calm;
  calm.action_noise = calm.push = 0.0;
  const Lessons lessons = take_lessons(teacher_of_squat(), {}, calm, nullptr, {1, 0});
  for (int row = 0; row < lessons.rows(); ++row) {
    const auto a = state_of(lessons, row), b = state_of(lessons, row - row % kLanes);
    ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin())) << row;
  }
}

TEST(Lessons, DependOnTheKeyOnly) {
  const rl::Agent student = clumsy_student();
  const Lessons a = take_lessons(teacher_of_squat(), {}, {}, &student, {1, 5}),
                b = take_lessons(teacher_of_squat(), {}, {}, &student, {1, 5}),
                c = take_lessons(teacher_of_squat(), {}, {}, &student, {1, 6});
  EXPECT_EQ(a.states, b.states);
  EXPECT_EQ(a.actions, b.actions);
  EXPECT_NE(a.states, c.states);
}

TEST(Lessons, ResetsLanesThatLeaveTheMotion) {
  const rl::Agent student = clumsy_student();
  LessonConfig strict;
  strict.off_path = 0.02;
  const Lessons lessons = take_lessons(teacher_of_squat(), {}, strict, &student, {1, 0});
  EXPECT_GT(lessons.put_back, 0);
  // The root offset of a state, its last two numbers, is the distance from the next frame's reference: it
  // never grows beyond what a body may stray, plus what the reference moves in a frame.
  for (int row = 0; row < lessons.rows(); ++row)
    for (const int entry : {1, 2})
      EXPECT_LT(std::abs(state_of(lessons, row)[std::size_t{570} - static_cast<std::size_t>(entry)]), 0.1f);
}

TEST(Lessons, MirroredLessonsAreMirrorImages) {
  const Lessons as_is = take_lessons(teacher_of_squat(), {}, {}, nullptr, {1, 0});
  const Lessons mirrored = take_lessons(teacher_of_squat(), {}, {}, nullptr, {1, 0}, Side::kMirrored);
  std::vector<float> state(rl::tracking::kStateSize), action(kDofs);
  ASSERT_EQ(as_is.rows(), mirrored.rows());
  for (int row = 0; row < as_is.rows(); ++row) {
    rl::tracking::reflect(rl::tracking::mirror_of_state(), state_of(as_is, row).data(), state.data());
    rl::tracking::reflect(rl::tracking::mirror_of_action(), as_is.actions.data() + row * kDofs,
                          action.data());
    ASSERT_TRUE(std::equal(state.begin(), state.end(), state_of(mirrored, row).begin())) << row;
    ASSERT_TRUE(std::equal(action.begin(), action.end(), mirrored.actions.begin() + row * kDofs)) << row;
  }
}

TEST(Lessons, ExpertActionDoesNotDependOnTheActingPolicy) {
  // In the first frame all lanes stand where the motion begins, whoever will act next.
  const rl::Agent student = clumsy_student();
  LessonConfig calm;
  calm.action_noise = calm.push = 0.0;
  const Lessons taught = take_lessons(teacher_of_squat(), {}, calm, nullptr, {1, 0}),
                own = take_lessons(teacher_of_squat(), {}, calm, &student, {1, 0});
  EXPECT_TRUE(
      std::equal(taught.actions.begin(), taught.actions.begin() + kLanes * kDofs, own.actions.begin()));
  EXPECT_NE(taught.states, own.states) << "the student acts in later frames";
}

TEST(Pushes, UntrainedAgentFallsUnderPushes) {
  control::PushTest test;
  test.trials = kLanes;
  EXPECT_EQ(test_pushes(teacher_of_squat().clip, {}, clumsy_student(), test).followed, 0);
}

}  // namespace
}  // namespace mimicx::teaching
