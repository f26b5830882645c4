/// Keypoint fit: before any training, the whole motion is moved onto its 2D keypoints.
///
/// Much of an estimator's error is a static bias of pose and place, which physics cannot remove and keypoints
/// can. The fit is one robust least-squares problem per clip; docs/method.md, "Keypoint fit", has its cost as
/// formulas. Its unknowns are, per frame, a *correction* of the input, so that its smoothness terms do not
/// flatten the motion:
///   root position p_input + c, rotations q_input · exp(c), hinge angles θ_input + c
/// and, per clip, the camera's tilt, its focal length, the shape β and a static offset of every keypoint
/// (a detector's idea of a joint is not the skeleton's), and the time between keypoints and motion. How much
/// each keypoint errs is found out from what is left over (fit/levels.h). Knees and elbows are exact hinges
/// throughout.
///
/// The solver is Gauss-Newton on a block-banded system with a border (fit/solver.h).
/// What it does not do: no foreign body meshes, no floor but the flat one, and it cannot tell depth from
/// focal length: what is left of the root's error is nearly all depth.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"
#include "motion/fit/config.h"

namespace mimicx::motion::fit {

/// What the fit did; every figure goes into the manifest.
struct FitReport {
  /// RMS over keypoints weighted by confidence, % of the box; after: without the static offsets.
  double residual_before = 0, residual_after = 0;
  int iterations = 0;
  double focal_scale = 1.0;         ///< estimated focal length over the one in the file
  double tilt_deg = 0.0;            ///< estimated turn of the camera about its horizontal axis
  double shape_change = 0.0;        ///< largest change of an entry of β
  double keypoint_sigma = 0.0;      ///< level found for the middle keypoint, % of the box
  double keypoint_sigma_max = 0.0;  ///< for the worst one
  double confidence_power = 0.0;    ///< found: σ grows with confidence to the minus this power
  double lead_frames = 0.0;         ///< frames by which the keypoints are ahead of the motion
  int swapped_frames = 0;           ///< frames in which left and right of arms or legs changed places back
  int dropped_points = 0;           ///< detections without confidence, or set aside as far off
  double change_mean_mm = 0, change_max_mm = 0;  ///< of joint positions against the input
  std::vector<std::string> notes;                ///< why nothing was done, and what is odd
};

/// The clip on its keypoints: same length and frame rate, our own body model and the fitted shape; keypoints
/// with left and right in order and the fitted camera. A clip without keypoints comes back unchanged, with a
/// note in the report. Deterministic. @param report  may be null
/// @throws DataError for fewer than 3 frames or values that are not finite
Clip fit_keypoints(const Clip& clip, const FitConfig& config, FitReport* report);

/// The same problem without detections: calms a motion that trembles from frame to frame, as single-frame
/// estimators leave it, and plants its feet. Keypoints and shape stay as they are. A motion whose joints
/// tremble by less than `kTremor`, or of fewer than 4 frames, comes back unchanged. @throws as fit_keypoints
Clip steady(const Clip& clip, const FitConfig& config, FitReport* report);
inline constexpr double kTremor = 0.3;  ///< degrees per axis of a knee, the white part of its rotation

}  // namespace mimicx::motion::fit
