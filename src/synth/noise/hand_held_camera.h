/// The camera of a synthetic or corrupted clip: its position, its motion in a hand, and the erroneous camera
/// that is given to the program.                             docs/method.md, "Noise model", (1) to (3)
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

/// The camera of a clip: one extrinsics matrix for all frames, or one per frame.
struct CameraPath {
  Matrix3d intrinsics = Matrix3d::Identity();
  PerFrame<Eigen::Matrix4d> extrinsics;

  CameraPath() = default;
  /// A camera that stands still.
  CameraPath(const Camera& camera) : intrinsics(camera.intrinsics), extrinsics{camera.extrinsics} {}
  bool is_moving() const { return extrinsics.count() > 1; }
  Camera at(int t) const { return {intrinsics, extrinsics[is_moving() ? t : 0]}; }
};

/// A camera 4 to 6 m away (farther only if the motion would leave the picture), 1.2 to 1.8 m high.
/// @throws std::invalid_argument when the motion does not fit into the picture at any distance
Camera place_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed);

/// A hand-held camera 3.5 to 5.5 m away (farther only if the motion would leave the picture). Its holder
/// walks a little and turns it after the person with unsteady hands.
/// @return extrinsics per frame  @throws std::invalid_argument as `place_camera`
CameraPath carry_camera(const PerFrame<BodyPoses>& truth, std::uint64_t seed, double fps);

/// Errors of the camera that is given to the program.
struct CameraError {
  double focal = 0.0;        ///< relative σ of the focal length
  double tilt = 0.0;         ///< σ of the tilt, degrees
  bool moving = false;       ///< the camera is carried (`carry_camera`) and given frame by frame
  double turn_drift = 0.0;   ///< random walk of the given orientation, per axis, °/√s
  double place_drift = 0.0;  ///< random walk of the given position, per axis, m/√s
};
/// "calibrated" (exact), "perturbed", "wild" or "moving". @throws std::invalid_argument for another name.
CameraError camera_error(std::string_view name);

/// The erroneous camera that is given to the program: focal length and tilt have constant errors, and the
/// path of a moving camera drifts away from its start.
CameraPath erroneous_camera(const CameraPath& camera, const CameraError& error, std::uint64_t seed,
                            double fps);

}  // namespace mimicx::synth
