/// How many plans teach one policy: the rounds, with their checkpoints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/run_context.h"
#include "teaching/plan_teachers.h"
#include "teaching/school.h"

namespace mimicx::teaching {

/// Teaches one policy by all of the plans; goes on where the checkpoint in the folder left it.
///
///     DIR/training/NAME.csv     a row per round: lessons, resets per thousand lessons, loss
///     DIR/checkpoints/NAME.npz  the pupil
///
/// @param task  with the simulation of all plans
/// @return none if it was interrupted; the checkpoint then has the finished rounds
std::optional<Pupil> teach_option(const std::vector<PlannedMotion>& motions, const SchoolConfig& school,
                                  const rl::tracking::TrackingConfig& task, const record::RunFolder& folder,
                                  const std::string& name, int threads, const record::RunContext& context);

}  // namespace mimicx::teaching
