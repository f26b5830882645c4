/// From a plan to a policy: rounds of lessons and regression.
///
/// In the first round everybody follows the teacher; then the student itself takes part (lessons.h). All
/// lessons stay, up to a bound, and every round ends with about as many gradient steps as the motion has
/// frames. In the second half of the rounds the student is rolled out alone after each, and the best one
/// stays: late rounds may unlearn a hard moment. Where none of them follows the motion, another stage of as
/// many rounds goes on; in these a wider student learns, from the lessons that are there and from its own.
#pragma once

#include <functional>

#include "control/plan_control.h"
#include "teaching/lessons.h"
#include "teaching/regression.h"

namespace mimicx::teaching {

struct StudentConfig {
  int hidden = 128;  ///< width of both hidden layers
  int wider = 2;    ///< the student of the later stages is so many times as wide and takes as many more steps
  int rounds = 14;  ///< of a stage
  int stages = 3;   ///< at most; the first after which a student follows the motion alone is the last
  int packs = 2;    ///< that take lessons side by side in a round
  double steps_per_frame = 1.0;  ///< gradient steps of a round, per frame of the motion
  int least_steps = 150;         ///< of a round, where the motion is short
  double step_size = 2e-3;       ///< Adam's at first; falls with the square of what is left of a stage
  double last_step_size = 5e-5;
  int most_rows = 64000;  ///< lessons beyond that replace the oldest
  std::uint64_t seed = 1;
  LessonConfig lessons;
  RegressionConfig regression;
};

struct RoundStats {
  int round = 0;
  int taken = 0;      ///< lessons so far, those included that were replaced
  int put_back = 0;   ///< bodies that left the path in this round
  double loss = 0.0;  ///< mean over the round's steps
};

/// @param watch  called after every round; may be empty
/// @return the best student; none where it was told to stop
std::optional<rl::Agent> teach(const Teacher& teacher, const rl::tracking::TrackingConfig& task,
                               const StudentConfig& config, const control::PlanControl& control,
                               const std::function<void(const RoundStats&, const rl::Agent&)>& watch = {});

}  // namespace mimicx::teaching
