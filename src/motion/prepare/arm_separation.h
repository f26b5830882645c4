/// Moves arms that an estimator left inside the trunk or the thighs out of them.
///
/// A simulated arm must not start inside the body: the contact forces would throw it out within a frame.
/// Therefore the arms of the reference are turned first, as little and as smoothly as possible.
///
/// What it does not do: legs are not moved, because their feet stand on the floor. Overlaps of a few
/// centimetres remain, because capsules are thicker than people in places and contact is soft.
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

inline constexpr double kAllowedOverlap = 0.05;  ///< m, of two capsules

/// The overlap that a frame may keep, m. It grows from 0 at the first frame to `kAllowedOverlap` after a
/// third of a second: a body that starts with an overlap is pushed by it at once, 10 N per mm, and only later
/// can hold against it.
double allowed_overlap(int frame, double fps);

/// Turns shoulders and elbows of the reference and updates `poses`. It minimises
///
///     Σ_t Σ_pairs max(0, d − d₀)²/σ_d²  +  Σ_t ‖c_t‖²/σ_c²  +  Σ_t ‖c_{t+1} − 2 c_t + c_{t−1}‖²/σ_b²
///
/// by Gauss–Newton. d is the overlap of a pair of capsules of which at least one belongs to an arm, d₀ is
/// `allowed_overlap`, and c_t are the turns of both arms in a frame: q exp(c) of a shoulder, θ + c of an
/// elbow. An elbow deep inside the trunk leaves it on its own side. σ_d = 3 mm, σ_c = 0.5 rad, σ_b = 0.02 rad
/// at 30 frames per second. Velocities do not change.
/// @param reference  q, p_root and poses are set; a reference without such an overlap stays unchanged
/// @return largest distance that a joint moved, m
double separate_arms(Reference& reference);

}  // namespace mimicx::motion
