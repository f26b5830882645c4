/// The errors of the motion in the independent noise model: joints, root, place.
///                                                                     docs/method.md, "Noise model", (4) to
///                                                                     (7)
/// Each term has its own random streams. What it does not do: no keypoints (independent_keypoints.h), no
/// body.
#pragma once

#include "synth/noise/estimated_motion.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/independent_preset.h"

namespace mimicx::synth {

/// Rotations of the joints and of the root.
void disturb_rotations(const IndependentPreset& preset, std::uint64_t seed, double fps,
                       EstimatedMotion& motion);

/// The root's path over the floor: speed, drift and heading; its root orientation turns with it.
void disturb_travel(const IndependentPreset& preset, std::uint64_t seed, double fps, EstimatedMotion& motion);

/// Where the person is: distance from the camera in the first frame, height, and a wobble about it.
void disturb_place(const IndependentPreset& preset, std::uint64_t seed, double fps, const CameraPath& camera,
                   EstimatedMotion& motion);

}  // namespace mimicx::synth
