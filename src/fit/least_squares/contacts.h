/// Finds the feet that stand. The keypoint fit does this anew before each of its steps.
#pragma once

#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Which foot points stand in which frame: [frames][kFootPoints].
using Contacts = PerFrame<Array<bool, kFootPoints>>;

/// A foot point stands where it is low and slow.
/// @param settled  true: the motion is on the floor already, and low means low over z = 0. False: low means
///                 low over a low percentile of the heights of the point's own foot
Contacts find_contacts(const PerFrame<FootPositions>& feet, double fps, bool settled);

/// Takes out the points of feet whose sole does not look down: of somebody who crawls or lies.
void keep_level_soles(const FitProblem& problem, const PerFrame<FrameKinematics>& motion, Contacts& contacts);

}  // namespace mimicx::fit
