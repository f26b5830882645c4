/// Smooths the path of a camera that trembles.                       docs/method.md, "Keypoint fit", "Camera"
///
/// The keypoint fit trusts the given camera of every frame. Where that camera trembles, all keypoints of a
/// frame have the same error. A nearer and smaller person would have to move less to explain it, so the fit
/// would shrink the motion.
/// What it does not do: no correction of slow camera errors, and no use of the keypoints.
#pragma once

#include "motion/clip.h"

namespace mimicx::fit {

/// Standard deviation of the white noise in a camera's path, per axis.
struct CameraJitter {
  double turn = 0.0;   ///< rad
  double place = 0.0;  ///< m
};
/// 0 for fewer than 4 frames. @param extrinsics  world → camera
CameraJitter jitter_of_camera(const PerFrame<Eigen::Matrix4d>& extrinsics);

inline constexpr double kCameraTurn = 0.05;    ///< degrees; a path with more white noise is smoothed …
inline constexpr double kCameraPlace = 0.003;  ///< m; … or with more than this

/// The path, smoothed where it trembles: turns and places are means under a Gaussian with σ = 0.1 s, which
/// reduces a sway of 0.7 Hz by a tenth. A steady path is returned unchanged.
PerFrame<Eigen::Matrix4d> smoothed_path(const PerFrame<Eigen::Matrix4d>& extrinsics, double fps);

}  // namespace mimicx::fit
