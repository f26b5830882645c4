/// Errors of joints, root and position in the independent noise model.
///                                                               docs/method.md, "Noise model", (4) to (7)
/// Each term has its own random streams. What it does not do: no keypoints (independent_keypoints.h), no body
/// shape.
#pragma once

#include "synth/noise/estimated_motion.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/independent_preset.h"

namespace mimicx::synth {

/// Disturbs the rotations of joints and root.
void disturb_rotations(const IndependentPreset& preset, std::uint64_t seed, double fps,
                       EstimatedMotion& motion);

/// Disturbs the root's path over the floor: speed, drift and heading. The root's orientation turns with it.
void disturb_travel(const IndependentPreset& preset, std::uint64_t seed, double fps, EstimatedMotion& motion);

/// Disturbs the person's position: distance from the camera in the first frame, height, and an oscillation.
void disturb_place(const IndependentPreset& preset, std::uint64_t seed, double fps, const CameraPath& camera,
                   EstimatedMotion& motion);

}  // namespace mimicx::synth
