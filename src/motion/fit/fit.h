/// Keypoint fit: before any training, the whole motion is moved onto its 2D keypoints.
///
/// Much of an estimator's error is a static bias of pose and place that physics cannot remove and keypoints
/// can (docs/method.md, "Keypoint fit"). One robust least-squares problem per clip; its unknowns are, per
/// frame, a *correction* of the input, so that its smoothness terms do not flatten the motion:
///   root position p_input + c, rotations q_input · exp(c), hinge angles θ_input + c
/// and, per clip, the camera's tilt, its focal length, the shape β and a static offset of every keypoint
/// (a detector's idea of a joint is not the skeleton's). Knees and elbows are exact hinges throughout.
///
/// Terms: keypoints, priors and smoothness of the corrections, acceleration of the result, feet on the floor
/// z = 0. Solver: Gauss-Newton on a block-banded system with a border (motion/fit/solver.h), one thread.
/// What it does not do: no foreign body meshes, no floor but the flat one, and it cannot tell depth from
/// focal length: what is left of the root's error is nearly all depth.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx {

/// Standard deviations of what the fit believes, and its effort.
struct FitOptions {
  int iterations = 12;  ///< of Gauss-Newton; contacts and labels are found anew in each

  // Keypoints, in heights of the person's box.
  double keypoint_sigma = 0.003;       ///< what changes from frame to frame; wrists three times as much
  double keypoint_bias_sigma = 0.005;  ///< static offset of a keypoint over the clip
  double keypoint_kernel = 0.03;       ///< residual at which a detection has lost half its weight

  // What is known of camera and body; 0 keeps what the file says.
  double focal_sigma = 0.01;        ///< relative
  double tilt_sigma = 0.3;          ///< degrees
  double beta_sigma = 0.15;         ///< per entry, where the shape is of our own body model
  double foreign_beta_sigma = 1.0;  ///< where the file's shape means nothing here (standard body)
  /// Errors of neighbouring frames are alike, so the frames together know less than their number says: camera
  /// and shape in the file count this many times.
  double told_weight = 10.0;

  // Corrections: size, and change from frame to frame at 30 fps.
  double joint_sigma = 6.0;          ///< degrees, times a weight per joint (motion/fit/problem.h)
  double root_rotation_sigma = 4.0;  ///< degrees
  double root_position_sigma = 1.0;  ///< m
  double prior_frames = 30.0;  ///< errors are alike over about so many frames: the size counts once for them
  double joint_rate = 2.0;     ///< degrees per frame, times the weight per joint
  double joint_bend = 0.6;     ///< degrees per frame²
  double root_rate = 0.003;    ///< m per frame
  double root_bend = 0.0006;   ///< m per frame²

  // The result.
  double acceleration_sigma = 0.012;  ///< m per frame², of every joint
  double floor_sigma = 0.02;          ///< m, height of a foot point that stands
  double slip_sigma = 0.002;          ///< m per frame, of a foot point that stands
  double penetration_sigma = 0.003;   ///< m, of a foot point below the floor
};

/// What the fit did; every figure goes into the manifest.
struct FitReport {
  /// RMS over keypoints weighted by confidence, % of the box; after: without the static offsets.
  double residual_before = 0, residual_after = 0;
  int iterations = 0;
  double focal_scale = 1.0;   ///< estimated focal length over the one in the file
  double tilt_deg = 0.0;      ///< estimated turn of the camera about its horizontal axis
  double shape_change = 0.0;  ///< largest change of an entry of β
  int swapped_frames = 0;     ///< frames in which left and right of arms or legs changed places back
  int dropped_points = 0;     ///< detections without confidence, or set aside as far off
  double change_mean_mm = 0, change_max_mm = 0;  ///< of joint positions against the input
  std::vector<std::string> notes;                ///< why nothing was done, and what is odd
};

/// The clip on its keypoints: same length and frame rate, our own body model and the fitted shape; keypoints
/// with left and right in order and the fitted camera. A clip without keypoints comes back unchanged, with a
/// note in the report. Deterministic. @param report  may be null
/// @throws DataError for fewer than 3 frames or values that are not finite
Clip fit_keypoints(const Clip& clip, const FitOptions& options, FitReport* report);

/// The same problem without detections: calms a motion that trembles from frame to frame, as single-frame
/// estimators leave it, and plants its feet. Keypoints and shape stay as they are. A motion whose joints
/// tremble by less than `kTremor`, or of fewer than 4 frames, comes back unchanged. @throws as fit_keypoints
Clip steady(const Clip& clip, const FitOptions& options, FitReport* report);
inline constexpr double kTremor = 0.3;  ///< degrees per axis of a knee, the white part of its rotation

}  // namespace mimicx
