/// The middle of a run by planning: optimal control finds residuals on the simulator's own derivatives
/// (control/plan.h), and these are rolled out over the whole of the motion, byte for byte what was planned.
///
/// The plan is left in plans/NAME.npz (plan_file.h). One that was finished for the same input is taken up
/// again; one that was interrupted starts anew. Where they are wanted, the feedback gains of a plan that was
/// followed are left in gains/NAME.npz. Where a plan is lost the residuals behind its end are zero:
/// the body goes on, and falls.
#pragma once

#include "control/cost.h"
#include "plan/plan_settings.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

/// The result is interrupted where the job's context stopped the plan.
/// @param planned  where not null: the plan itself
run::SimulatedSequence plan_sequence(const motion::Reference& reference, const PlanningConfig& config,
                                     const run::SequenceJob& job, control::Plan* planned = nullptr);

inline constexpr float kBridged = 0.1f;

/// Certainty of every body, [frames] × [kBodies], in (0, 1]:
///
///     c = min(1, (a₀/a)⁴)
///
/// a is the largest acceleration in the frame and its two neighbours, m/s², by second differences of the
/// reference: of an arm's or leg's joints relative to the shoulder or hip, and of the trunk's joints. All
/// bodies of a limb have one certainty, because a foot is where it is by the rotations of hip and knee.
/// Frames that preparation had to bridge (Reference::flagged) have at most `kBridged`.
/// @param plausible  a₀, m/s²; 0: everything is certain, the list is empty
List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible);

}  // namespace mimicx::plan
