/// What a stranger's 2D detector makes of the motion it sees.          docs/method.md, "Noise model", (10) to
/// (15)
///
/// Its idea of a joint turns with the limb and with the view; its errors grow for limbs that point at the
/// camera and for what the body hides; they have heavy tails; and its confidence hardly tells.
/// What it does not do: no images, no second person.
#pragma once

#include "synth/noise/detected_points.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/independent_preset.h"

namespace mimicx::synth {

/// The person that is seen: body, and root and joint rotations of every frame.
struct SeenMotion {
  const Character& character;
  const PerFrame<Vector3d>& p_root;  ///< m
  const PerFrame<PerBody<Quaterniond>>& q;
  double fps;
};

/// World poses at a time between frames (clamped to the clip): places linearly, rotations by slerp.
BodyPoses pose_between(const SeenMotion& motion, double frame);

/// How much of a keypoint's bone the camera does not see for its direction: 0 across the ray, 1 along it.
/// @param eye  m, world
double foreshortening(const BodyPoses& poses, const Landmark& point, const Vector3d& eye);

/// Detections of the clean motion through the true camera; the told camera is not its matter.
motion::Keypoints detect_independently(const SeenMotion& truth, const CameraPath& camera,
                                       motion::KeypointSet set, const IndependentPreset& preset,
                                       std::uint64_t seed);

}  // namespace mimicx::synth
