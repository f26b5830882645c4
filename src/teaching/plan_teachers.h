/// Reads the plans of a run of `mimicx plan --gains` (or `adapt`) as teachers.
///
/// Such a teacher acts on the plan's reference with all its errors, because a policy for unknown motions will
/// observe such references; the teacher shows what a body can do. Or it acts on the planned motion itself,
/// for policies that follow a planner.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "record/run_folder.h"
#include "teaching/teacher.h"

namespace mimicx::teaching {

struct PlannedMotion {
  record::RunFolder run;
  std::string name;       ///< in that folder
  std::string input;      ///< that was planned
  std::string checksum;   ///< of the plan's file, as the run recorded it
  bool followed = false;  ///< to the end
};

/// Motions of a run that were planned, in the order of its manifest.
/// @throws DataError for a folder that is no run
std::vector<PlannedMotion> planned_motions(const record::RunFolder& run);
/// Those with a complete plan and gains.
/// @param told  gets a line per other motion, which says why it is left out
std::vector<PlannedMotion> followed_plans(const record::RunFolder& run, std::ostream* told = nullptr);

/// The motion that a policy follows when a plan teaches or tests it.
enum class Followed { kReference, kPlan };

/// The reference of the plan, or the planned motion.
motion::Reference reference_of(const PlannedMotion& motion, Followed followed = Followed::kReference);

/// @throws DataError naming file and member that is missing, of another shape, or of another simulation than
/// the task's
Teacher read_teacher(const PlannedMotion& motion, const rl::tracking::TrackingConfig& task,
                     Followed followed = Followed::kReference);

}  // namespace mimicx::teaching
