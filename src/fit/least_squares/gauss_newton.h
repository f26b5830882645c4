/// The solution of a fit: Gauss-Newton over its terms, with contacts, labels and levels found anew.
///                                                                docs/method.md, "Keypoint fit", "Solution"
///
/// What it does not do: it does not decide whether there is anything to fit (keypoint_fit.h, pose_fit.h).
#pragma once

#include "fit/fit_report.h"
#include "fit/least_squares/fit_problem.h"

namespace mimicx::fit {

/// The clip at the problem's solution; as it is, with a note, where there is none.
/// @param problem  its levels and its `settled` change
motion::Clip solved(const motion::Clip& clip, FitProblem& problem, FitReport& report);

}  // namespace mimicx::fit
