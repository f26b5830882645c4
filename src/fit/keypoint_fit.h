/// Keypoint fit: before any training, the whole motion is moved onto its 2D keypoints.
///
/// Much of an estimator's error is a static bias of pose and place, which physics cannot remove and keypoints
/// can. The fit is one robust least-squares problem per clip; docs/method.md, "Keypoint fit", has its cost as
/// formulas. Its unknowns are, per frame, a *correction* of the input, so that its smoothness terms do not
/// flatten the motion:
///   root position p_input + c, rotations q_input · exp(c), hinge angles θ_input + c
/// and, per clip, the camera's tilt, its focal length, the shape β and a static offset of every keypoint
/// (a detector's idea of a joint is not the skeleton's), and the time between keypoints and motion. How much
/// each keypoint errs is found out from what is left over (fit/least_squares/error_levels.h). Knees and
/// elbows are exact hinges throughout.
///
/// The solver is Gauss-Newton on a block-banded system with a border (fit/least_squares/bordered_band.h).
/// What it does not do: no foreign body meshes, no floor but the flat one, and it cannot tell depth from
/// focal length: what is left of the root's error is nearly all depth.
#pragma once

#include "fit/fit_config.h"
#include "fit/fit_report.h"
#include "motion/clip.h"

namespace mimicx::fit {

/// The clip on its keypoints: same length and frame rate, our own body model and the fitted shape; keypoints
/// with left and right in order and the fitted camera. A clip without keypoints comes back unchanged, with a
/// note in the report. Deterministic. @param report  may be null
/// @throws DataError for fewer than 3 frames or values that are not finite
motion::Clip fit_keypoints(const motion::Clip& clip, const FitConfig& config, FitReport* report);

}  // namespace mimicx::fit
