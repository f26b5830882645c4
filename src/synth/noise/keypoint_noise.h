/// 2D detections, keypoints with errors.                         docs/method.md, "Noise model", (11) to (16)
///
/// The offset of a keypoint turns with its limb and with the view. Errors grow for limbs that point at the
/// camera and for hidden points, and have heavy tails. Confidence is only weakly correlated with the error.
/// What it does not do: no images, no second person.
#pragma once

#include "synth/noise/detected_points.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/noise_preset.h"

namespace mimicx::synth {

/// The motion that the detector sees.
struct SeenMotion {
  const Character& character;
  const PerFrame<Vector3d>& p_root;  ///< m
  const PerFrame<PerBody<Quaterniond>>& q;
  double fps;
};

/// World poses at a time between frames, clamped to the clip: positions interpolated linearly, rotations by
/// slerp.
BodyPoses pose_between(const SeenMotion& motion, double frame);

/// How much a keypoint's bone is foreshortened: 0 perpendicular to the ray, 1 along it.
/// @param eye  m, world
double foreshortening(const BodyPoses& poses, const Landmark& point, const Vector3d& eye);

/// Detections of the clean motion in the picture of the true camera; the camera of the result is not set.
motion::Keypoints detect_keypoints(const SeenMotion& truth, const CameraPath& camera, motion::KeypointSet set,
                                   const NoisePreset& preset, std::uint64_t seed);

}  // namespace mimicx::synth
