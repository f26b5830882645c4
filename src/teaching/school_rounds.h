/// How many plans teach one policy: the rounds, with their checkpoints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/progress.h"
#include "teaching/plan_teachers.h"
#include "teaching/school.h"

namespace mimicx::teaching {

/// One policy to be taught.
struct OptionLessons {
  std::string name;                    ///< of its files
  std::vector<PlannedMotion> motions;  ///< whose plans teach it
  SchoolConfig school;
  rl::tracking::TrackingConfig task;  ///< with the simulation of all plans
};

/// Teaches one policy by all of the plans; continues from the checkpoint in the folder.
///
///     DIR/training/NAME.csv     a row per round: lessons, resets per thousand lessons, loss
///     DIR/checkpoints/NAME.npz  the pupil
///
/// @return none if it was interrupted; the checkpoint then has the finished rounds
std::optional<Pupil> teach_option(const OptionLessons& option, const record::RunFolder& folder, int threads,
                                  const record::RunContext& context);

}  // namespace mimicx::teaching
