/// From a plan to a policy: rounds of lessons and regression.
///
/// In the first round all lanes follow the teacher; later the student acts in some of them (lessons.h). All
/// lessons are kept up to a bound, and every round ends with about as many gradient steps as the motion has
/// frames. In the second half of the rounds the student is rolled out unaided after each, and the best one is
/// kept, because late rounds may unlearn a hard part. If none of them follows the motion, another stage of as
/// many rounds begins. In it a wider student learns from the existing lessons and from its own.
#pragma once

#include <functional>

#include "control/plan_control.h"
#include "teaching/lessons.h"
#include "teaching/regression.h"

namespace mimicx::teaching {

struct StudentConfig {
  int hidden = 128;  ///< width of both hidden layers
  int wider = 2;     ///< factor on width and steps of the student in later stages
  int rounds = 14;   ///< of a stage
  int stages = 3;    ///< at most; the last is the first after which a student follows the motion unaided
  int packs = 2;     ///< packs of characters per round, in parallel
  double steps_per_frame = 1.0;  ///< gradient steps of a round, per frame of the motion
  int least_steps = 150;         ///< least gradient steps of a round, for short motions
  double step_size =
      2e-3;  ///< Adam's first step size; falls with the square of the remaining share of a stage
  double last_step_size = 5e-5;
  int most_rows = 64000;  ///< most lessons; further ones replace the oldest
  std::uint64_t seed = 1;
  LessonConfig lessons;
  RegressionConfig regression;
};

/// core/setting.h.
void visit_settings(StudentConfig& student, const auto& visit) {
  visit("hidden", student.hidden, 1, 4096, "units of both hidden layers");
  visit("wider", student.wider, 1, 64, "factor on units and steps in later stages");
  visit("rounds", student.rounds, 1, 10000, "rounds of lessons and regression in a stage");
  visit("stages", student.stages, 1, 1000, "stages, at most");
  visit("least_steps", student.least_steps, 1, 1e6, "gradient steps of a round, at least");
  visit_settings(student.lessons, visit);
}

struct RoundStats {
  int round = 0;
  int taken = 0;      ///< lessons so far, including replaced ones
  int put_back = 0;   ///< resets in this round
  double loss = 0.0;  ///< mean over the round's steps
};

/// @param watch  called after every round; may be empty
/// @return the best student; none if it was stopped
std::optional<rl::Agent> teach_student(
    const Teacher& teacher, const rl::tracking::TrackingConfig& task, const StudentConfig& config,
    const control::PlanControl& control,
    const std::function<void(const RoundStats&, const rl::Agent&)>& watch = {});

}  // namespace mimicx::teaching
