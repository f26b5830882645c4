/// A told camera that trembles, calmed.                              docs/method.md, "Keypoint fit", "Camera"
///
/// The keypoint fit takes the camera of every frame as told. Where that trembles, all keypoints of a frame
/// err together, and a nearer and smaller person would have to move less: the fit would shrink the world.
/// What it does not do: no slow errors of the camera, and no look at the keypoints.
#pragma once

#include "motion/clip.h"

namespace mimicx::fit {

/// White part of a camera's path, per axis.
struct CameraJitter {
  double turn = 0.0;   ///< rad
  double place = 0.0;  ///< m
};
/// 0 for fewer than 4 frames. @param extrinsics  world → camera
CameraJitter jitter_of_camera(const PerFrame<Eigen::Matrix4d>& extrinsics);

inline constexpr double kCameraTurn = 0.05;    ///< degrees: a camera that trembles by more is calmed …
inline constexpr double kCameraPlace = 0.003;  ///< m: … or by more than this

/// The path as it is where it does not tremble; else turns and places are means under a Gaussian of 0.1 s,
/// which takes a tenth of a sway of 0.7 Hz along.
PerFrame<Eigen::Matrix4d> calmed(const PerFrame<Eigen::Matrix4d>& extrinsics, double fps);

}  // namespace mimicx::fit
