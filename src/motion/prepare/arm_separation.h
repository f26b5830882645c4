/// Arms that an estimator left inside the trunk or the thighs are moved out of them.
///
/// A simulated arm cannot start inside the body: contact would throw it out within a frame. So the reference
/// comes out of the body first. Its arms turn as little and as smoothly as that takes.
///
/// What it does not do: legs stay where they are, because their feet stand on the floor; overlaps of a few
/// centimetres stay, because capsules are thicker than people in places and contact is soft.
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

inline constexpr double kAllowedOverlap = 0.05;  ///< m, of two capsules

/// Turns shoulders and elbows of the reference's frames and computes `poses` anew. It minimises
///
///     Σ_t Σ_pairs max(0, d − d₀)²/σ_d²  +  Σ_t ‖c_t‖²/σ_c²  +  Σ_t ‖c_{t+1} − 2 c_t + c_{t−1}‖²/σ_b²
///
/// by Gauss–Newton. d is the overlap of a pair of capsules with an arm among them, d₀ `kAllowedOverlap`, c_t
/// the turns of both arms in a frame: q exp(c) of a shoulder, θ + c of an elbow. σ_d = 3 mm, σ_c = 0.5 rad,
/// σ_b = 0.02 rad at 30 frames per second. Velocities are not touched.
/// @param reference  q, p_root and poses are set; a reference without such an overlap stays as it is
/// @return largest distance that a joint was moved, m
double separate_arms(Reference& reference);

}  // namespace mimicx::motion
