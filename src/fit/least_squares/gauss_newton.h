/// Solves a fit by Gauss-Newton; contacts, sides and error levels are updated in every iteration.
///                                                                docs/method.md, "Keypoint fit", "Solution"
///
/// What it does not do: it does not decide whether there is anything to fit (keypoint_fit.h, pose_fit.h).
#pragma once

#include "fit/fit_report.h"
#include "fit/least_squares/fit_problem.h"

namespace mimicx::fit {

/// The clip at the problem's solution; the unchanged clip, with a note, where the solver fails.
/// @param problem  its levels, sides and `settled` change
motion::Clip solved(const motion::Clip& clip, FitProblem& problem, FitReport& report);

}  // namespace mimicx::fit
