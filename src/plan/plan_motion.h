/// Plans one motion: optimal control on the simulator's derivatives finds residuals (control/plan.h), and
/// their roll-out over the whole motion repeats the plan byte for byte.
///
/// The plan is written to plans/NAME.npz (plan_file.h). A finished plan of the same input, reference and
/// simulation is reused; an interrupted one starts again. On request, the feedback gains of a successful plan
/// are written to gains/NAME.npz. If a plan fails, the residuals after its end are zero, and the body falls
/// in the rest of the roll-out.
#pragma once

#include "plan/plan_settings.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

/// The result is interrupted if the job's context stopped the plan.
/// @param planned  if not null, gets the plan itself
run::SimulatedSequence plan_sequence(const motion::Reference& reference, const PlanningConfig& config,
                                     const run::SequenceJob& job, control::Plan* planned = nullptr);

/// Plans a reference and simulates it. Meaningless if the watch stopped it.
/// @param settings  with the factors of this reference
rl::tracking::TrackingRollout planned_rollout(const motion::Reference& reference,
                                              const physics::SimulationConfig& simulation,
                                              const control::PlanConfig& settings, run::JobWatch& watch);

}  // namespace mimicx::plan
