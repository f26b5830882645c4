// Many motions teach one policy.
#include "teaching/school.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

#include "rl/tracking/mirror.h"
#include "rl/tracking/tracking_rollout.h"
#include "teaching/taught_motion.h"

namespace mimicx::teaching {
namespace {

SchoolConfig quick_school() {
  SchoolConfig config;
  config.hidden = {32, 16};
  config.rounds = 4;
  config.packs = 2;
  config.passes = 1.0;
  config.regression.minibatch = 64;
  return config;
}

/// Enough to learn the squat.
SchoolConfig thorough() {
  SchoolConfig config = quick_school();
  config.hidden = {64, 64};
  config.rounds = 8;
  config.packs = 4;
  config.passes = 6.0;
  return config;
}

/// Everybody is taught by the one teacher of the squat.
Teacher squat(int) { return teacher_of_squat(); }

Pupil taught(const SchoolConfig& config, int threads = 1, const Teachers& teacher = squat) {
  Pupil pupil = untrained_pupil(config);
  for (int round = 0; round < config.rounds; ++round) {
    EXPECT_TRUE(teach_round(teacher, 3, {}, config, {.threads = threads}, pupil));
  }
  return pupil;
}

std::string bytes_of(const Pupil& pupil) {
  Npz archive;
  save(archive, "", pupil);
  return format_npz(archive);
}

TEST(School, FewRoundsTeachAMotion) {
  const Pupil pupil = taught(thorough(), 2);
  const auto alone =
      rl::tracking::roll_out(teacher_of_squat().clip, {}, rl::tracking::mean_action({pupil.agent}));
  EXPECT_LT(alone.mean_position_error, 0.02);
}

TEST(School, VisitsEveryTeacherBeforeRepeating) {
  SchoolConfig config = quick_school();
  config.packs = 3;
  Pupil pupil = untrained_pupil(config);
  std::mutex mutex;
  std::vector<int> visited;
  const Teachers teachers = [&](int k) {
    const std::lock_guard guard(mutex);
    visited.push_back(k);
    return teacher_of_squat();
  };
  constexpr int kTeachers = 5;
  std::vector<std::vector<int>> orders;
  for (int round = 0; round < 5; ++round) teach_round(teachers, kTeachers, {}, config, {.threads = 1}, pupil);
  ASSERT_EQ(visited.size(), 15u);
  for (auto begin = visited.begin(); begin != visited.end(); begin += kTeachers) {
    orders.emplace_back(begin, begin + kTeachers);
    EXPECT_EQ(std::set<int>(begin, begin + kTeachers).size(), 5u);
  }
  EXPECT_TRUE(orders[0] != orders[1] || orders[1] != orders[2]) << "shuffled anew";
}

TEST(School, DependsOnTheSeedNotOnThreads) {
  SchoolConfig config = quick_school();
  const std::string one = bytes_of(taught(config, 1));
  EXPECT_EQ(one, bytes_of(taught(config, 2)));
  config.seed = 2;
  EXPECT_NE(one, bytes_of(taught(config, 1)));
}

TEST(School, SavedPupilContinuesWithTheSameBytes) {
  const SchoolConfig config = quick_school();
  Pupil pupil = untrained_pupil(config);
  for (int round = 0; round < config.rounds; ++round) {
    Npz archive;
    save(archive, "x.", pupil);
    pupil = load_pupil(archive, "x.");
    teach_round(squat, 3, {}, config, {.threads = 1}, pupil);
  }
  EXPECT_EQ(bytes_of(pupil), bytes_of(taught(config)));
}

TEST(School, RejectsOptimiserMomentsOfAnotherNetwork) {
  SchoolConfig narrow, wide;
  narrow.hidden = {2, 2}, wide.hidden = {2, 3};
  Pupil pupil = untrained_pupil(narrow);
  pupil.adam = untrained_pupil(wide).adam;
  Npz archive;
  save(archive, "x.", pupil);
  EXPECT_THROW(load_pupil(archive, "x."), DataError);
}

TEST(School, StoppedRoundLeavesThePupilUnchanged) {
  const SchoolConfig config = quick_school();
  Pupil pupil = untrained_pupil(config);
  teach_round(squat, 3, {}, config, {.threads = 1}, pupil);
  const std::string before = bytes_of(pupil);
  control::PlanControl control;
  control.threads = 1;
  control.should_stop = [] { return true; };
  EXPECT_FALSE(teach_round(squat, 3, {}, config, control, pupil));
  EXPECT_EQ(bytes_of(pupil), before);
}

/// What the agent does in the first frame of the squat on a body of which it is told another shape.
nn::Matrix<float> first_action(const rl::Agent& agent, float beta) {
  const rl::tracking::TrackingPack pack(teacher_of_squat().clip, {});
  nn::Matrix<float> state(1, rl::tracking::kStateSize), normalised, action;
  pack.observe(0, state.data());
  state.middleCols(rl::tracking::kPoseFeatures, kBetas).setConstant(beta);
  nn::normalise(agent.observations, state, normalised);
  nn::Workspace<float> workspace;
  nn::evaluate(agent.actor, normalised, workspace, action);
  return action;
}

TEST(School, PupilSeesTheBodyShapeOnlyOnRequest) {
  SchoolConfig config = quick_school();
  config.rounds = 1;
  rl::Agent blind = taught(config).agent;
  config.see_shape = true;
  rl::Agent seeing = taught(config).agent;
  EXPECT_EQ(first_action(seeing, 0.0f), first_action(seeing, 3.0f)) << "the lessons are of one body";
  const nn::Moments of_another_body[] = {
      nn::moments_of(nn::Matrix<float>(nn::Matrix<float>::Constant(1, rl::tracking::kStateSize, 3.0f)))};
  for (rl::Agent* agent : {&blind, &seeing}) nn::update<float>(agent->observations, of_another_body);
  EXPECT_EQ(first_action(blind, 0.0f), first_action(blind, 3.0f));
  EXPECT_NE(first_action(seeing, 0.0f), first_action(seeing, 3.0f));
}

/// How far an agent is from doing in the mirror what it does before it, over the states of some lessons.
float asymmetry(const rl::Agent& agent, const Lessons& lessons) {
  const int state_size = rl::tracking::kStateSize;
  const auto act = [&](const nn::Matrix<float>& states) {
    nn::Matrix<float> normalised, actions;
    nn::normalise(agent.observations, states, normalised);
    nn::Workspace<float> workspace;
    nn::evaluate(agent.actor, normalised, workspace, actions);
    return actions;
  };
  const nn::Matrix<float> states =
      Eigen::Map<const nn::Matrix<float>>(lessons.states.data(), lessons.rows(), state_size);
  nn::Matrix<float> images(states.rows(), states.cols());
  for (int k = 0; k < lessons.rows(); ++k)
    rl::tracking::reflect(rl::tracking::mirror_of_state(), states.row(k).data(), images.row(k).data());
  const nn::Matrix<float> actions = act(states), of_images = act(images);
  nn::Matrix<float> expected(actions.rows(), actions.cols());
  for (int k = 0; k < lessons.rows(); ++k)
    rl::tracking::reflect(rl::tracking::mirror_of_action(), actions.row(k).data(), expected.row(k).data());
  return (of_images - expected).norm() / actions.norm();
}

/// The squat with one arm held to the side.
Teacher one_sided(int) {
  Teacher teacher = teacher_of_squat();
  for (int t = 0; t < teacher.size(); ++t) teacher.motion.u[t][first_dof(kLeftShoulder) + 2] += 0.5f;
  return teacher;
}

TEST(School, MirroredLessonsFavourNoSide) {
  SchoolConfig config = thorough();
  const Lessons lessons = take_lessons(one_sided(0), {}, {}, nullptr, {77, 0});
  config.mirror = false;
  const float alone = asymmetry(taught(config, 1, one_sided).agent, lessons);
  config.mirror = true;
  EXPECT_LT(asymmetry(taught(config, 1, one_sided).agent, lessons), 0.7f * alone);
}

}  // namespace
}  // namespace mimicx::teaching
