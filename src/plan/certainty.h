/// How much of a reference is to be believed, frame by frame and limb by limb.
///
/// An estimator that takes one leg for the other, or a detector that does for a few frames, leaves a foot
/// that is somewhere else for a moment. The reference jumps there and back. No body can do that, and a plan
/// that tries to falls. Such a limb is recognised by an acceleration that no human reaches, and its weight in
/// the plan's cost falls until the rest of the body decides where it is.
///
/// What it does not do: the reference itself stays as it is, and so do the metrics against it.
#pragma once

#include "control/cost.h"
#include "motion/reference.h"

namespace mimicx::plan {

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

inline constexpr float kBridged = 0.1f;

}  // namespace mimicx::plan
