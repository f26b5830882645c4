/// What is known of a reference, frame by frame: how certain its bodies are, and how feasible its momentum
/// is. These are the factors of the plan's cost (control/cost/cost.h).
#pragma once

#include "audit/pose_needs.h"
#include "control/cost/cost.h"
#include "motion/reference.h"
#include "plan/plan_settings.h"

namespace mimicx::plan {

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
/// @param plausible  a₀, m/s²; 0: everything is certain
List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible);

/// How far a body can have the momentum of the reference, [frames], in (0, 1]:
///
///     m = 1/(1 + (f/f₀)²)²
///
/// f is the external force that the frame needs, in body weights (audit/pose_needs.h), at its largest within
/// `kNeedReach`.
/// @param tolerated  f₀  @param needs  of the reference; without frames: 1
List<float> momentum_factors(const audit::PoseNeeds& needs, int frames, double tolerated);

List<control::FrameFactors> factors_of(const motion::Reference& reference, const audit::PoseNeeds& needs,
                                       const MotionPlanConfig& config);

}  // namespace mimicx::plan
