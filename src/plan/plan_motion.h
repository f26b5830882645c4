/// The middle of a run by planning: optimal control finds residuals on the simulator's own derivatives
/// (control/plan.h), and these are rolled out over the whole of the motion, byte for byte what was planned.
///
/// The plan is left in plans/NAME.npz (plan_file.h). One that was finished for the same input is taken up
/// again; one that was interrupted starts anew. Where they are wanted, the feedback gains of a plan that was
/// followed are left in gains/NAME.npz. Where a plan is lost the residuals behind its end are zero:
/// the body goes on, and falls.
#pragma once

#include "plan/plan_settings.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

/// The result is interrupted where the job's context stopped the plan.
/// @param planned  where not null: the plan itself
run::SimulatedSequence plan_sequence(const motion::Reference& reference, const PlanningConfig& config,
                                     const run::SequenceJob& job, control::Plan* planned = nullptr);

}  // namespace mimicx::plan
