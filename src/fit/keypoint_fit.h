/// Keypoint fit: moves the whole motion onto its 2D keypoints before any training.
///
/// Much of an estimator's error is a constant bias of pose and position. Physics cannot remove it; keypoints
/// can. The fit is one robust least-squares problem per clip; docs/method.md, "Keypoint fit", has its cost.
/// Its unknowns per frame are a *correction* of the input, so that the smoothness terms do not flatten the
/// motion:
///   root position p_input + c, rotations q_input · exp(c), hinge angles θ_input + c
/// Its unknowns per clip are the camera's tilt and focal length, the shape β, a constant offset of every
/// keypoint (a detector places a joint elsewhere than the skeleton does), and the time between keypoints and
/// motion. The error level of each keypoint is estimated from the residuals (least_squares/error_levels.h).
/// Knees and elbows are exact hinges throughout.
///
/// The solver is Gauss-Newton on a block-banded system with a border (least_squares/bordered_band.h).
/// What it does not do: no meshes of other bodies, no slopes. It cannot separate depth from focal
/// length: the remaining error of the root is nearly all depth.
#pragma once

#include "fit/fit_config.h"
#include "fit/fit_report.h"
#include "motion/clip.h"

namespace mimicx::fit {

/// The clip moved onto its keypoints: same length and frame rate, our own body model with the fitted shape,
/// keypoints with left and right in order, and the fitted camera. A clip without keypoints is returned
/// unchanged, with a note in the report. Deterministic. @param report  may be null
/// @throws DataError for fewer than 3 frames or values that are not finite
motion::Clip fit_keypoints(const motion::Clip& clip, const FitConfig& config, FitReport* report);

}  // namespace mimicx::fit
