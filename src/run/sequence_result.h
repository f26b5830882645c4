/// What became of one motion of a run: judged, recorded in its entry, and written.
#pragma once

#include "audit/pose_needs.h"
#include "record/manifest.h"
#include "record/run_folder.h"
#include "run/method.h"
#include "run/preparation.h"

namespace mimicx::run {

/// A prepared motion and what its reference asks for that no body has.
struct JudgedMotion : PreparedMotion {
  audit::PoseNeeds needs;
};

/// What the reference asks for that no body can do, into the entry.
void judge_reference(const audit::PoseNeeds& needs, record::SequenceEntry& entry);

/// Scores and audit of what the method made, into the entry.
void judge_sequence(const motion::Reference& reference, const physics::SimulationConfig& simulation,
                    const SimulatedSequence& made, record::SequenceEntry& entry);

/// Fit, reference and its feasibility, simulated motion, the policy that it was taught and, where wanted, its
/// physics steps. The entry gets their names and checksums.
void write_sequence(const record::RunFolder& folder, bool substeps,
                    const physics::SimulationConfig& simulation, const JudgedMotion& motion,
                    const SimulatedSequence& made, record::SequenceEntry& entry);

}  // namespace mimicx::run
