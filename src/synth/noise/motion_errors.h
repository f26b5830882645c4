/// Errors of joints, root and position.                docs/method.md, "Noise model", (4) to (7) and (10)
///
/// Each term has its own random streams. What it does not do: no keypoints (keypoint_noise.h), no body
/// shape.
#pragma once

#include "synth/noise/estimated_motion.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/noise_preset.h"

namespace mimicx::synth {

/// Disturbs the rotations of joints and root.
void disturb_rotations(const NoisePreset& preset, std::uint64_t seed, double fps, EstimatedMotion& motion);

/// Disturbs the root's path over the floor: speed, drift and heading. The root's orientation turns with it.
void disturb_travel(const NoisePreset& preset, std::uint64_t seed, double fps, EstimatedMotion& motion);

/// Disturbs the person's position: distance from the camera in the first frame, height, and an oscillation.
void disturb_place(const NoisePreset& preset, std::uint64_t seed, double fps, const CameraPath& camera,
                   EstimatedMotion& motion);

/// The estimator's floor: removes a share of the error of the lowest surface point's height, and adds a mean
/// error. @param mistaken  the body that moves  @param body, truth  body and poses without errors
void put_on_floor(const NoisePreset& preset, const Character& mistaken, const Character& body,
                  const PerFrame<BodyPoses>& truth, EstimatedMotion& motion);

}  // namespace mimicx::synth
