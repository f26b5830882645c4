/// What a 2D detector makes of the motion it sees: keypoints with errors.
///
/// Source: docs/method.md, "Noise model". Errors are in units of the person's box in the picture.
/// What it does not do: no images, no occlusion by geometry.
#pragma once

#include "motion/keypoint_names.h"
#include "motion/synth/camera.h"
#include "motion/synth/noise_streams.h"

namespace mimicx::motion::synth {

/// Detections of the clean motion. @param truth  poses of every frame
Keypoints detect_keypoints(const PerFrame<BodyPoses>& truth, const CameraPath& camera, KeypointSet set,
                           const std::vector<Burst>& bursts, std::uint64_t seed, double fps);

}  // namespace mimicx::motion::synth
