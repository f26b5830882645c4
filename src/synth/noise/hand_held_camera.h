/// The camera that sees a synthetic or corrupted clip: where it stands, how it moves in a hand, and what the
/// program is told of it.                                              docs/method.md, "Noise model", (1) to
/// (3)
///
/// What it does not do: no lens distortion, no rolling shutter, no images.
#pragma once

#include <cstdint>
#include <string_view>

#include "motion/clip.h"

namespace mimicx::synth {

/// A pinhole camera: world → camera (x right, y down, z forward), intrinsics in pixels.
struct Camera {
  Matrix3d intrinsics = Matrix3d::Identity();
  Eigen::Matrix4d extrinsics = Eigen::Matrix4d::Identity();
};

/// u, v in pixels and depth in metres.
Vector3d project(const Camera& camera, const Vector3d& p_W);

/// Where a camera is in the world, m.
Vector3d eye_of(const Eigen::Matrix4d& extrinsics);

/// A camera over a clip: extrinsics of all frames, or one per frame.
struct CameraPath {
  Matrix3d intrinsics = Matrix3d::Identity();
  PerFrame<Eigen::Matrix4d> extrinsics;

  CameraPath() = default;
  /// One that stands still.
  CameraPath(const Camera& camera) : intrinsics(camera.intrinsics), extrinsics{camera.extrinsics} {}
  bool is_moving() const { return extrinsics.count() > 1; }
  Camera at(int t) const { return {intrinsics, extrinsics[is_moving() ? t : 0]}; }
};

/// A camera 4 to 6 m away (farther only when the motion would leave the picture), 1.2 to 1.8 m high.
/// @throws std::invalid_argument when the motion would leave it at any distance
Camera place_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed);

/// A camera in the hands of somebody who stands 3.5 to 5.5 m away (farther only when the motion would leave
/// the picture), walks a little, and turns after the person with unsteady hands.
/// @return one place per frame  @throws std::invalid_argument as `place_camera`
CameraPath carry_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed, double fps);

/// How much the program is told about the camera and the body's shape.
struct CameraError {
  double focal = 0.0;        ///< relative σ of the focal length
  double tilt = 0.0;         ///< σ of the tilt, degrees
  double beta = 0.0;         ///< σ per entry of β
  bool moving = false;       ///< the camera is carried (`carry_camera`), and told frame by frame
  double turn_drift = 0.0;   ///< growth of the error of the told orientation, per axis, °/√s
  double place_drift = 0.0;  ///< growth of the error of the told place, per axis, m/√s
};
/// "calibrated" (exact), "perturbed", "wild" or "moving". @throws std::invalid_argument for another name.
CameraError camera_error(std::string_view name);

/// The camera as the program is told of it: focal length and tilt are off over the whole clip, and what is
/// told of a moving camera drifts away from its start.
CameraPath told_camera(const CameraPath& camera, const CameraError& error, std::uint64_t seed, double fps);

}  // namespace mimicx::synth
