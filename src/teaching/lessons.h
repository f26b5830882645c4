/// Lessons: what a body saw, and what the teacher would have done there.
///
/// A pack of characters goes through the whole motion side by side. The first lane follows the teacher
/// undisturbed; some others follow the teacher too, the rest follow the student; all of these are disturbed
/// by noise on their actions and by pushes. Whatever they do, what is written down is what the teacher would
/// have done. So the student learns what to do in the states that its own mistakes lead to.
/// Source: Ross, Gordon, Bagnell, "A reduction of imitation learning and structured prediction to no-regret
/// online learning" (DAgger), AISTATS 2011.
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
  double off_path = 0.3;       ///< a body farther from the teacher's own is put back to it, m
  int teacher_lanes = 2;       ///< of a pack, that follow the teacher once there is a student
};

/// In which world a lesson is written down: as it was, or as its mirror image (rl/tracking/mirror.h).
enum class Side { kAsIs, kMirrored };

/// Rows of lessons.
struct Lessons {
  List<float> states;    ///< [rows][state_size] s_t, not normalised
  List<float> actions;   ///< [rows][55] the teacher's, rad
  List<int> weighed_by;  ///< [rows] which matrix says what a wrong action costs (regression.h): the frame
  int put_back = 0;      ///< how often a body was put back onto the motion

  int rows() const { return weighed_by.count(); }
};

/// Behind the rows that are there.
void append_lessons(const Lessons& more, Lessons& lessons);

/// An agent that has learnt nothing: two or more hidden layers, mean actions near zero.
rl::Agent beginner(int state_size, const std::vector<int>& hidden, std::uint64_t seed);

/// The agent's inputs are scaled by what these lessons show.
void scale_inputs(const Lessons& lessons, rl::Agent& agent);

/// One pack goes through the motion once: frames × lanes rows.
/// @param student  null: everybody follows the teacher
/// @param key  of the random numbers
/// @param side  mirrored: the student sees and acts as in the mirrored motion, and its lessons are of that
/// one
Lessons take_lessons(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                     const LessonConfig& config, const rl::Agent* student, std::uint64_t seed,
                     std::uint64_t key, Side side = Side::kAsIs);

/// How well an agent keeps to the motion while it is pushed, by the rules of control/gains.h.
control::PushResult test_pushes(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                const rl::tracking::TrackingConfig& task, const rl::Agent& agent,
                                const control::PushTest& test);

}  // namespace mimicx::teaching
