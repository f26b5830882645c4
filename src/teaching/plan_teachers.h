/// The plans in the folder of a run of `mimicx plan --gains` (or `adapt`), as teachers.
///
/// Such a teacher acts on the reference that was planned for, with all its errors, since that is what whoever
/// follows unknown motions gets to see; what it shows is what a body can do with it. Or it acts on the
/// planned motion itself: what whoever comes behind a planner gets to see.
#pragma once

#include <string>
#include <vector>

#include "record/run_folder.h"
#include "teaching/teacher.h"

namespace mimicx::teaching {

struct PlannedMotion {
  record::RunFolder run;
  std::string name;       ///< in that folder
  std::string input;      ///< that it was planned for
  std::string checksum;   ///< of the plan's file, as the run recorded it
  bool followed = false;  ///< to the end
};

/// Motions of a run that were planned, in the order of its manifest.
/// @throws DataError for a folder that is no run
std::vector<PlannedMotion> planned_motions(const record::RunFolder& run);
/// Those whose plan was followed to the end and that have gains.
std::vector<PlannedMotion> followed_plans(const record::RunFolder& run);

/// What whoever learns from a plan, or is tried by it, follows.
enum class Followed { kReference, kPlan };

/// What was planned for, or what came of it.
motion::Reference reference_of(const PlannedMotion& motion, Followed followed = Followed::kReference);

/// @throws DataError naming file and member that is not there, not of its shape, or not the task's
/// simulation
Teacher read_teacher(const PlannedMotion& motion, const rl::tracking::TrackingConfig& task,
                     Followed followed = Followed::kReference);

}  // namespace mimicx::teaching
