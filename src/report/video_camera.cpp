#include "report/video_camera.h"

#include "motion/keypoint_names.h"
#include "record/json.h"
#include "report/base64_digits.h"

namespace mimicx::report {
namespace {

constexpr double kCameraSteps = 1e8;      ///< per unit of the camera's numbers: more precise than visible
constexpr double kTenths = 10.0;          ///< of a pixel
constexpr double kFullConfidence = 63.0;  ///< the largest digit

/// The point at the joint of the nearest ancestor body that has one; −1: none.
int next_up(const std::vector<SeenPoint>& points, std::size_t k) {
  const bool at_joint = points[k].p_B.isZero();
  for (int body = at_joint ? kParents[points[k].body] : points[k].body; body >= 0; body = kParents[body])
    for (std::size_t up = 0; up < points.size(); ++up)
      if (up != k && points[up].body == body && points[up].p_B.isZero()) return static_cast<int>(up);
  return -1;
}

record::Json placed_json(const PlacedCamera& camera) {
  const Matrix3d& K = camera.intrinsics;
  record::Json extrinsics = record::Json::array();
  for (const Eigen::Matrix4d& pose : camera.extrinsics) {
    record::Json one = record::Json::array();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) one.push_back(rounded(pose(row, column), kCameraSteps));
    extrinsics.push_back(one);
  }
  return {{"fx", rounded(K(0, 0), kCameraSteps)},   {"fy", rounded(K(1, 1), kCameraSteps)},
          {"cx", rounded(K(0, 2), kCameraSteps)},   {"cy", rounded(K(1, 2), kCameraSteps)},
          {"skew", rounded(K(0, 1), kCameraSteps)}, {"extrinsics", extrinsics}};
}

}  // namespace

std::optional<ReportCamera> camera_of(const motion::Clip& clip) {
  if (!clip.keypoints || clip.keypoints->extrinsics.empty()) return std::nullopt;
  const motion::Keypoints& all = *clip.keypoints;
  const Character character = motion::character_of(clip);
  ReportCamera camera{{all.intrinsics, all.extrinsics}, {}, {}, {}, {}};
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < all.names.size(); ++k)
    if (const auto place = motion::place_of_keypoint(all.names[k])) {
      camera.points.push_back({place->body, motion::place_on(character, *place)});
      columns.push_back(k);
    }
  if (columns.empty()) return std::nullopt;
  for (std::size_t k = 0; k < camera.points.size(); ++k)
    if (const int up = next_up(camera.points, k); up >= 0) camera.bones.push_back({static_cast<int>(k), up});
  for (const std::vector<Vector3d>& frame : all.uvc) {
    camera.uvc.emplace_back();
    for (const std::size_t k : columns) camera.uvc.back().push_back(frame[k]);
  }
  return camera;
}

std::vector<double> distances_from_seen(const ReportCamera& camera, const PlacedCamera& from,
                                        const std::vector<BodyPoses>& poses) {
  std::vector<double> means;
  for (int t = 0; t < static_cast<int>(poses.size()); ++t) {
    double sum = 0.0, weight = 0.0;
    if (t < camera.uvc.count()) {
      const Eigen::Matrix4d& pose = motion::camera_at(from.extrinsics, t);
      for (std::size_t k = 0; k < camera.points.size(); ++k) {
        const auto& [body, p_B] = camera.points[k];
        const BodyPoses& now = poses[static_cast<std::size_t>(t)];
        const Eigen::Vector4d p_W = Vector3d(now.p_WB[body] + now.q_WB[body] * p_B).homogeneous();
        const Vector3d image = from.intrinsics * (pose * p_W).head<3>();
        const double confidence = camera.uvc[t][k].z();
        if (confidence <= 0.0) continue;
        sum += image.z() > 0.0 ? confidence * (image.hnormalized() - camera.uvc[t][k].head<2>()).norm()
                               : kNoValue;
        weight += confidence;
      }
    }
    means.push_back(weight > 0.0 ? sum / weight : kNoValue);
  }
  return means;
}

std::string camera_json(const ReportCamera& camera) {
  record::Json json = placed_json(camera.placed);
  if (camera.told) json["told"] = placed_json(*camera.told);
  json["bones"] = camera.bones;
  json["points"] = record::Json::array();
  for (const SeenPoint& point : camera.points) {
    record::Json one = record::Json::array();
    one.push_back(point.body);
    for (const double x : point.p_B) one.push_back(rounded(x, kCameraSteps));
    json["points"].push_back(one);
  }
  Digits seen;
  for (const std::vector<Vector3d>& frame : camera.uvc)
    for (const Vector3d& point : frame) {
      for (int k = 0; k < 2; ++k) seen.put(kTenths * point[k], 3);
      seen.put_count(kFullConfidence * point.z(), 1);
    }
  json["seen"] = seen.text();
  return json.dump();
}

}  // namespace mimicx::report
