/// What the camera of a clip saw: the detections that are points of the body, and the camera itself.
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
  PlacedCamera placed;               ///< as the clip was cleaned with it
  std::optional<PlacedCamera> told;  ///< as the input was told, where that is another: the input's own view
  std::vector<SeenPoint> points;     ///< [K]
  std::vector<std::array<int, 2>> bones;  ///< lines between points, child and the next one up the body
  PerFrame<std::vector<Vector3d>> uvc;    ///< [frames][K] px and confidence
};

/// Of keypoints that are on no body (face, fingers) none are taken. Empty: no camera, or no such point.
std::optional<ReportCamera> camera_of(const motion::Clip& clip);

/// Mean distance of the points of a motion from where they were seen, each counting by its confidence, px per
/// frame. NaN where nothing was seen, or a point is behind the camera.
/// @param from  where the motion is looked at from
std::vector<double> distances_from_seen(const ReportCamera& camera, const PlacedCamera& from,
                                        const std::vector<BodyPoses>& poses);

/// `fx`, `fy`, `cx`, `cy`, `skew`, px; `extrinsics`, [1 or frames][12], rows of (R t); `told`, the same of
/// the input's, where it has its own; `points`, [K][4]: body, place; `bones`; `seen`, digits: [frame][K] u
/// and v of 3 digits, tenths of a pixel, and a count of 1 digit, confidence in parts of 63.
std::string camera_json(const ReportCamera& camera);

}  // namespace mimicx::report
