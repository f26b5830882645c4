/// What the keypoint fit or the pose fit did to a motion.
#pragma once

#include <string>
#include <vector>

#include "core/containers.h"

namespace mimicx::fit {

/// Every number but those of glitches, which preparation reports, is written into the manifest.
struct FitReport {
  bool fitted = false;  ///< false: the motion is as it was, and a note says why
  /// RMS over keypoints weighted by confidence, % of the box; `residual_after` without the constant offsets.
  double residual_before = 0, residual_after = 0;
  int iterations = 0;
  double focal_scale = 1.0;         ///< estimated focal length over the one in the file
  double tilt_deg = 0.0;            ///< estimated turn of the camera about its horizontal axis
  double shape_change = 0.0;        ///< largest change of an entry of β
  double keypoint_sigma = 0.0;      ///< estimated σ of the median keypoint, % of the box
  double keypoint_sigma_max = 0.0;  ///< of the worst keypoint
  double confidence_power = 0.0;    ///< estimated p: σ grows with confidence^−p
  double lead_frames = 0.0;         ///< frames by which the keypoints are ahead of the motion
  int swapped_frames = 0;           ///< frames in which left and right of arms or legs were exchanged
  int dropped_points = 0;           ///< detections without confidence, or rejected as outliers
  double change_mean_mm = 0, change_max_mm = 0;  ///< of joint positions against the input
  std::vector<std::string> notes;                ///< why nothing was done, and what is unusual
  PerFrame<bool> flagged;  ///< [frames] interpolated before the fit (motion/prepare/bridging.h), or empty
  int limb_frames = 0;     ///< the same of single limbs
};

}  // namespace mimicx::fit
