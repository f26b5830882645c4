#include "synth/noise/detected_points.h"

#include <algorithm>
#include <limits>

#include "core/elementary.h"

namespace mimicx::synth {
namespace {

double side_of(const std::string& name) { return name.starts_with("left_") ? 1.0 : -1.0; }

/// Where the points of COCO that are no joints lie on the head, m; those of the face around the nose.
Vector3d place_on_head(const std::string& name) {
  if (name == "nose") return {0.0, 0.055, 0.100};
  if (name.starts_with("face-")) {
    const double angle = std::stod(name.substr(5));  // anywhere on an oval
    return {0.06 * cos(angle), 0.05 + 0.08 * sin(angle), 0.085};
  }
  return name.ends_with("eye") ? Vector3d(side_of(name) * 0.032, 0.085, 0.080)
                               : Vector3d(side_of(name) * 0.075, 0.065, 0.005);
}

/// Where a finger's joint lies on the hand, m: knuckles side by side, the tips away from the wrist.
Vector3d place_on_hand(const std::string& name) {
  int across = 2;
  for (const char* finger : {"thumb", "forefinger", "middle", "ring", "pinky"}) {
    if (name.find(finger) != std::string::npos)
      return {side_of(name) * (0.065 + 0.02 * (name.back() - '0')), 0.0, 0.02 * across};
    --across;
  }
  return Vector3d::Zero();
}

/// A detector marks the skin: not quite where the keypoint fit takes these points to be (keypoint_names.h).
Vector3d place_on_foot(const std::string& name) {
  const double side = side_of(name);
  if (name.ends_with("heel")) return {0.0, -0.052, -0.058};
  return name.ends_with("big_toe") ? Vector3d(side * -0.024, -0.006, 0.060)
                                   : Vector3d(side * 0.034, -0.008, 0.046);
}

Landmark landmark_of(const std::string& name) {
  if (const int body = body_of_name(name); body >= 0) return {name, body, Vector3d::Zero()};
  const bool left = side_of(name) > 0.0;
  if (name.ends_with("heel")) return {name, left ? kLeftAnkle : kRightAnkle, place_on_foot(name)};
  if (name.ends_with("toe")) return {name, left ? kLeftFoot : kRightFoot, place_on_foot(name)};
  if (name.find("finger") != std::string::npos || name.find("thumb") != std::string::npos ||
      name.ends_with("hand_root"))
    return {name, left ? kLeftWrist : kRightWrist, place_on_hand(name)};
  return {name, kHead, place_on_head(name)};
}

}  // namespace

std::vector<Landmark> landmarks(motion::KeypointSet set) {
  std::vector<Landmark> points;
  for (const std::string& name : motion::keypoint_names(set)) points.push_back(landmark_of(name));
  return points;
}

std::size_t mirror_of(const std::vector<Landmark>& points, std::size_t k) {
  const std::string name = motion::mirrored_name(points[k].name);
  const auto found =
      std::find_if(points.begin(), points.end(), [&](const Landmark& p) { return p.name == name; });
  return static_cast<std::size_t>(found - points.begin());
}

bool is_descendant(int body, int ancestor) {
  while (body > ancestor) body = kParents[body];
  return body == ancestor;
}

double box_size(const Camera& camera, const BodyPoses& poses) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& joint : poses.p_WB) {
    const Eigen::Vector2d uv = project(camera, joint).head<2>();
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  return (high - low).maxCoeff();
}

}  // namespace mimicx::synth
