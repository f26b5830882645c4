/// Plans one motion: optimal control on the simulator's derivatives finds residuals (control/plan.h), and
/// their roll-out over the whole motion repeats the plan byte for byte.
///
/// The plan is written to plans/NAME.npz (plan_file.h). A finished plan of the same input is reused; an
/// interrupted one starts again. On request, the feedback gains of a successful plan are written to
/// gains/NAME.npz. If a plan fails, the residuals after its end are zero, and the body falls in the rest of
/// the roll-out.
#pragma once

#include "control/cost.h"
#include "plan/plan_settings.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

/// The result is interrupted if the job's context stopped the plan.
/// @param planned  if not null, gets the plan itself
run::SimulatedSequence plan_sequence(const motion::Reference& reference, const PlanningConfig& config,
                                     const run::SequenceJob& job, control::Plan* planned = nullptr);

inline constexpr float kBridged = 0.1f;  ///< largest certainty of frames that preparation bridged

/// Certainty of every body, [frames] × [kBodies], in (0, 1], a factor on its weight in the plan's cost:
///
///     c = min(1, (a₀/a)⁴)
///
/// An estimator that confuses left and right for a few frames lets a foot jump away and back. No body can do
/// that, and a plan that follows it falls. Such a limb is recognised by its acceleration, and the rest of the
/// body then decides where it is. The reference itself, and the metrics against it, do not change.
///
/// a is the largest acceleration in the frame and its two neighbours, m/s², by second differences of the
/// reference: of an arm's or leg's joints relative to the shoulder or hip, and of the trunk's joints. All
/// bodies of a limb have the same certainty, because the rotations of hip and knee place the foot. Frames
/// that preparation bridged (Reference::flagged) have at most `kBridged`.
/// @param plausible  a₀, m/s²; 0: everything is certain, the list is empty
List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible);

}  // namespace mimicx::plan
