/// Finds the feet that stand. The fit repeats this before each of its steps.
#pragma once

#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Whether a foot point stands in a frame, [frames][kFootPoints].
using Contacts = PerFrame<Array<bool, kFootPoints>>;

/// The middle of the sole that a foot point belongs to, m: a foot stands on what is under it. Toes that an
/// estimate has in the side of the next step do not.
Vector3d sole_middle(const FootPositions& feet, int point);

/// A foot point stands where it is low and slow, and through jumps of an estimate
/// (`motion::stand_through_jumps`).
/// @param settled  true: the motion is on the floor, and heights count from z = 0. False: they count from a
///                 low percentile of the heights of the point's own foot
Contacts find_contacts(const PerFrame<FootPositions>& feet, double fps, const Scene& scene, bool settled);

/// Removes the contacts of feet whose sole does not face down, as of a person who crawls or lies.
void keep_level_soles(const FitProblem& problem, const PerFrame<FrameKinematics>& motion, Contacts& contacts);

}  // namespace mimicx::fit
