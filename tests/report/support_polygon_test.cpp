#include "report/support_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "character/character.h"
#include "core/random.h"

namespace mimicx::report {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - b;
  return u.x() * v.y() - u.y() * v.x();
}

/// What makes a polygon the hull: its corners are points, it turns left at each, and no point is outside.
TEST(ConvexHull, IsCounterClockwiseAndContainsAllPoints) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Polygon points;
    for (int i = 0; i < 3 + trial % 12; ++i)
      points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
    const Polygon hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const auto &a = hull[i], &b = hull[(i + 1) % hull.size()], &c = hull[(i + 2) % hull.size()];
      EXPECT_NE(std::find(points.begin(), points.end(), a), points.end());
      EXPECT_GT(turn(a, b, c), 0.0);
      for (const Eigen::Vector2d& p : points) EXPECT_GE(turn(a, b, p), -1e-12);
    }
  }
}

TEST(ConvexHull, CollinearPointsGiveTheirEnds) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}}), (Polygon{{1, 2}}));
  EXPECT_EQ(convex_hull({{2, 2}, {0, 0}, {1, 1}, {3, 3}}).size(), 2u);
}

TEST(SupportPolygon, IsTheHullOfTheTouchingSolePoints) {
  std::vector<Vector3d> surface(kFootPoints + 5, Vector3d(9.0, 9.0, 0.0));  // others lie on the floor, too
  for (std::size_t i = 0; i < kFootPoints; ++i) {
    const bool left = i < kPointsPerFoot;
    surface[i] = Vector3d(left ? 0.2 : -0.2, 0.1 * static_cast<double>(i % 3), left ? 0.004 : 0.006);
    surface[i].x() += i % 2 == 0 ? 0.05 : 0.0;
  }
  const Polygon polygon = support_of(surface);
  ASSERT_GE(polygon.size(), 3u);
  for (const Eigen::Vector2d& p : polygon) EXPECT_GT(p.x(), 0.0) << "of the left foot alone";
  for (Vector3d& p : surface) p.z() = 0.1;
  EXPECT_TRUE(support_of(surface).empty());
}

}  // namespace
}  // namespace mimicx::report
