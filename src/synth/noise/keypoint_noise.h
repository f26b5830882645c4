/// 2D detections of the first noise model: keypoints with errors.
///
/// Source: docs/method.md, "Noise model". Errors are in units of the person's box in the picture.
/// What it does not do: no images, no occlusion by geometry.
#pragma once

#include "motion/keypoint_names.h"
#include "synth/noise/hand_held_camera.h"
#include "synth/noise/random_processes.h"

namespace mimicx::synth {

/// Detections of the clean motion. @param truth  poses of every frame
motion::Keypoints detect_keypoints(const PerFrame<BodyPoses>& truth, const CameraPath& camera,
                                   motion::KeypointSet set, const std::vector<Burst>& bursts,
                                   std::uint64_t seed, double fps);

}  // namespace mimicx::synth
