#include "motion/synth/detected_points.h"

#include <algorithm>
#include <limits>

namespace mimicx::motion::synth {
namespace {

/// Where the points of COCO that are no joints lie on the head, m.
Vector3d place_on_head(const std::string& name) {
  if (name == "nose") return {0.0, 0.055, 0.100};
  const double side = name.starts_with("left_") ? 1.0 : -1.0;
  return name.ends_with("eye") ? Vector3d(side * 0.032, 0.085, 0.080) : Vector3d(side * 0.075, 0.065, 0.005);
}

}  // namespace

std::vector<Landmark> landmarks(KeypointSet set) {
  std::vector<Landmark> points;
  for (const std::string& name : keypoint_names(set)) {
    const int body = body_of_name(name);
    points.push_back(body < 0 ? Landmark{name, kHead, place_on_head(name)}
                              : Landmark{name, body, Vector3d::Zero()});
  }
  return points;
}

std::size_t mirror_of(const std::vector<Landmark>& points, std::size_t k) {
  std::string name = points[k].name;
  if (name.starts_with("left_"))
    name.replace(0, 5, "right_");
  else if (name.starts_with("right_"))
    name.replace(0, 6, "left_");
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

}  // namespace mimicx::motion::synth
