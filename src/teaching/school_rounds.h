/// Teaching one policy by many plans: its settings by name, and the rounds with their checkpoints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/named_values.h"
#include "record/run_context.h"
#include "teaching/plan_teachers.h"
#include "teaching/school.h"

namespace mimicx::teaching {

/// The numbers by name; all begin with "school_".
NamedValues school_settings(const SchoolConfig& school);

/// Changes one of them. @return whether the name exists
/// @throws std::invalid_argument for a fraction where a whole number is expected
bool change_setting(SchoolConfig& school, const std::string& name, double value);

/// @throws std::invalid_argument naming a setting that no school can have
void check(const SchoolConfig& school);

/// Teaches one policy by all of the plans; continues from the checkpoint in the folder.
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
