#include "report/support_polygon.h"

#include <algorithm>

#include "motion/metrics.h"

namespace mimicx::report {
namespace {

/// Whether the path a, b, c turns left.
bool turns_left(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d there = b - a, on = c - a;
  return there.x() * on.y() - there.y() * on.x() > 0.0;
}

}  // namespace

Polygon convex_hull(Polygon points) {
  const auto in_order = [](const auto& a, const auto& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), in_order);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto chain = [](auto first, auto last) {
    Polygon corners;
    for (; first != last; ++first) {
      while (corners.size() > 1 && !turns_left(corners[corners.size() - 2], corners.back(), *first))
        corners.pop_back();
      corners.push_back(*first);
    }
    corners.pop_back();  // the other chain begins with it
    return corners;
  };
  Polygon hull = chain(points.begin(), points.end());
  const Polygon back = chain(points.rbegin(), points.rend());
  hull.insert(hull.end(), back.begin(), back.end());
  return hull;
}

Polygon support_of(const std::vector<Vector3d>& surface, const Scene& scene) {
  Polygon touching;
  for (std::size_t i = 0; i < kFootPoints; ++i)
    if (scene.clearance(surface[i]) <= motion::kContactHeight) touching.emplace_back(surface[i].head<2>());
  return convex_hull(std::move(touching));
}

}  // namespace mimicx::report
