/// The camera of a synthetic clip, and what a 2D detector makes of the motion it sees: keypoints with errors.
///
/// Source: docs/method.md, "Noise model". Errors are in units of the person's box in the picture.
/// What it does not do: no images, no occlusion by geometry.
#pragma once

#include "motion/clip.h"
#include "motion/keypoint_names.h"
#include "motion/synth/noise_streams.h"

namespace mimicx::motion::synth {

/// A pinhole camera: world → camera (x right, y down, z forward), intrinsics in pixels.
struct Camera {
  Matrix3d intrinsics = Matrix3d::Identity();
  Eigen::Matrix4d extrinsics = Eigen::Matrix4d::Identity();
};

/// u, v in pixels and depth in metres.
Vector3d project(const Camera& camera, const Vector3d& p_W);

/// A camera 4 to 6 m away (farther only when the motion would leave the picture), 1.2 to 1.8 m high.
/// @throws std::invalid_argument when the motion would leave it at any distance
Camera place_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed);

/// Detections of the clean motion. @param truth  poses of every frame
Keypoints detect_keypoints(const PerFrame<BodyPoses>& truth, const Camera& camera, KeypointSet set,
                           const std::vector<Burst>& bursts, std::uint64_t seed, double fps);

}  // namespace mimicx::motion::synth
