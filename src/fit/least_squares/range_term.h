/// The term of the fits that keeps joints inside their ranges.      docs/method.md, "Keypoint fit", (7)
#pragma once

#include "fit/least_squares/bordered_band.h"
#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Adds the normal equations of frame t: the squared distances of its joints beyond their ranges
/// (character/joint_range.h) over `range_sigma`². Adds nothing for joints inside.
/// @param k  kinematics of the frame
void add_ranges(const FitProblem& problem, const FrameKinematics& k, int t, BorderedBand& system);

}  // namespace mimicx::fit
