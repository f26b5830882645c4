/// Lessons, the data set of DAgger: observed states, labelled with the expert's actions.
///
/// A pack of characters goes through the whole motion in parallel. The first lane follows the teacher
/// undisturbed. Some other lanes follow the teacher, the rest the student, all of them disturbed by action
/// noise and pushes. The recorded action is always the teacher's. So the student learns to act in the states
/// that its own errors lead to. Source: Ross, Gordon, Bagnell, "A reduction of imitation learning and
/// structured prediction to no-regret online learning" (DAgger), AISTATS 2011.
#pragma once

#include <cstdint>

#include "nn/matrix.h"
#include "rl/policy.h"
#include "teaching/teacher.h"

namespace mimicx::teaching {

struct LessonConfig {
  double action_noise = 0.05;  ///< standard deviation on every entry of an action, rad
  double push = 0.15;          ///< standard deviation of a push of the pelvis in x and in y, m/s
  int push_every = 15;         ///< frames from push to push
  double off_path = 0.3;       ///< a lane with a body farther than this from the teacher's is reset, m
  int teacher_lanes = 2;       ///< lanes of a pack that follow the teacher once there is a student
};

/// core/setting.h.
void visit_settings(LessonConfig& lessons, const auto& visit) {
  visit("action_noise", lessons.action_noise, 0, 1, "sigma of the noise on actions in lessons, rad");
  visit("push", lessons.push, 0, 10, "sigma of pushes of the pelvis in lessons, m/s");
  visit("off_path", lessons.off_path, 1e-3, 10, "distance at which a body is put back to the teacher, m");
}

/// In which world a lesson is written down: as it was, or as its mirror image (rl/tracking/mirror.h).
enum class Side { kAsIs, kMirrored };

/// Rows of lessons.
struct Lessons {
  List<float> states;    ///< [rows][state_size] s_t, not normalised
  List<float> actions;   ///< [rows][55] the teacher's, rad
  List<int> weighed_by;  ///< [rows] index of the row's error weight W_t (regression.h): the frame
  int put_back = 0;      ///< number of resets onto the motion

  int rows() const { return weighed_by.count(); }
};

/// Appends the rows of `more`.
void append_lessons(const Lessons& more, Lessons& lessons);

/// Sets the agent's input normalisation from the states of these lessons.
void scale_inputs(const Lessons& lessons, rl::Agent& agent);

/// Key of the random numbers of lessons.
struct LessonKey {
  std::uint64_t seed;  ///< of the training
  std::uint64_t pack;  ///< number of the pack in the training
};

/// One pack goes through the motion once: frames × lanes rows.
/// @param student  null: all lanes follow the teacher
/// @param side  mirrored: the student observes and acts in the mirrored motion, and the lessons are those of
/// it
Lessons take_lessons(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                     const LessonConfig& config, const rl::Agent* student, const LessonKey& key,
                     Side side = Side::kAsIs);

/// How well an agent follows the motion under pushes, by the rules of control/gains.h.
control::PushResult test_pushes(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                const rl::tracking::TrackingConfig& task, const rl::Agent& agent,
                                const control::PushTest& test);

}  // namespace mimicx::teaching
