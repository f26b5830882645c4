/// The result of one motion of a run: judged, recorded in its entry, written, and found damaged later.
#pragma once

#include "audit/pose_needs.h"
#include "judge/scores.h"
#include "record/manifest.h"
#include "record/run_folder.h"
#include "run/method.h"
#include "run/preparation.h"
#include "run/run_state.h"

namespace mimicx::run {

/// A prepared motion, the external wrench that its reference would need, and the scores of its input.
struct JudgedMotion : PreparedMotion {
  audit::PoseNeeds needs;
  judge::InputScores input_scores;
};

/// Removes all files of an entry whose input has changed, so that none of them is taken for the new input's.
/// The motion goes last, and nothing is done without it: work that was stopped later finds the files that it
/// left for the new input. No input is among them (claim_run).
void remove_result(const record::RunFolder& folder, const record::SequenceEntry& entry);

/// Writes the reference's feasibility into the entry.
void judge_reference(const audit::PoseNeeds& needs, record::SequenceEntry& entry);

/// Writes scores and audit of the method's result into the entry.
void judge_sequence(const JudgedMotion& motion, const physics::SimulationConfig& simulation,
                    const SimulatedSequence& made, record::SequenceEntry& entry);

/// Writes fit, reference, feasibility, simulated motion, followed parts, taught policy and, where the result
/// has them, physics steps. The entry gets their names and checksums.
/// @param parts  of a motion that is no success
void write_sequence(const RunState& run, const JudgedMotion& motion, const SimulatedSequence& made,
                    const List<FollowedPart>& parts, record::SequenceEntry& entry);

/// Names in the folder of the entry's files that are missing, truncated or changed.
std::vector<std::string> damaged_files(const record::RunFolder& folder, const record::SequenceEntry& entry);

}  // namespace mimicx::run
