/// Error levels of the fit: those of corrections and offsets are given, those of detections are estimated.
///                                                               docs/method.md, "Keypoint fit", "Levels"
///
/// What it does not do: no solution of the fit itself (keypoint_fit.h, bordered_band.h). The levels of the
/// corrections, of the offsets and the correlation are given, not estimated: docs/experiments.md, "Keypoint
/// fit", says why.
#pragma once

#include "fit/least_squares/bordered_band.h"
#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Correlation of a detection's error between neighbouring frames of the clip.
double correlation_of(const FitProblem& problem);

/// σ of the corrections of a frame, of their first differences and of their second ones.
struct CorrectionLevels {
  FrameVector size, rate, bend;
};
CorrectionLevels correction_levels(const FitProblem& problem);

/// Square root of the weight of every detection: 1/σ reduced by its robust kernel; 0 where it is not used.
/// [frames][K]
PerFrame<std::vector<double>> detection_weights(const FitProblem& problem, const FitState& state,
                                                const PerFrame<FrameKinematics>& motion);

/// One step of expectation-maximisation: the levels of the detections that maximise the likelihood of the
/// residuals of a state, given the state's own uncertainty.  docs/method.md, "Keypoint fit", (11), (12)
/// @param draws  samples of the state's error (SolutionWithDraws)
FitLevels levels_of(const FitProblem& problem, const FitState& state, const PerFrame<FrameKinematics>& motion,
                    const std::vector<BandSolution>& draws);

}  // namespace mimicx::fit
