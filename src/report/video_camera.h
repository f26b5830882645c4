/// The camera of a clip, and the detections that are points of the body.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::report {

/// A keypoint as a point of a body.
struct SeenPoint {
  int body = 0;
  Vector3d p_B = Vector3d::Zero();  ///< body's frame, m
};

struct PlacedCamera {
  Matrix3d intrinsics = Matrix3d::Identity();  ///< px
  PerFrame<Eigen::Matrix4d> extrinsics;        ///< one, or one per frame: world → camera
};

struct ReportCamera {
  PlacedCamera placed;               ///< with which the clip was cleaned
  std::optional<PlacedCamera> told;  ///< of the input, if different: the input's own view
  std::vector<SeenPoint> points;     ///< [K]
  std::vector<std::array<int, 2>>
      bones;                            ///< lines between points: a point and the next one towards the pelvis
  PerFrame<std::vector<Vector3d>> uvc;  ///< [frames][K] px and confidence
};

/// Keypoints that are on no body (face, fingers) are left out. Empty: no camera, or no point.
std::optional<ReportCamera> camera_of(const motion::Clip& clip);

/// Distance of a motion's points from their detections in the picture, a mean weighted by confidence, px per
/// frame. NaN without detections, or if a point is behind the camera.
/// @param from  the camera that sees the motion
std::vector<double> distances_from_seen(const ReportCamera& camera, const PlacedCamera& from,
                                        const std::vector<BodyPoses>& poses);

/// `fx`, `fy`, `cx`, `cy`, `skew`, px; `extrinsics`, [1 or frames][12], rows of (R t); `told`, the same of
/// the input's camera, if different; `points`, [K][4]: body, place; `bones`; `seen`, digits: [frame][K] u and
/// v in tenths of a pixel, 3 digits each, and confidence in parts of 63, a count of 1 digit.
std::string camera_json(const ReportCamera& camera);

}  // namespace mimicx::report
