#include "render/raster.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/containers.h"
#include "core/random.h"

namespace mimicx::render {
namespace {

constexpr int kGridWidth = 40, kGridHeight = 30;

List<int> counts_of(const List<GridTriangle>& triangles) {
  List<int> counts(kGridWidth * kGridHeight, 0);
  for (const GridTriangle& t : triangles)
    for_each_sample(t, kGridWidth, kGridHeight,
                    [&](int x, int y, const Vector3d&) { ++counts[y * kGridWidth + x]; });
  return counts;
}

GridTriangle random_triangle(Random& random) {
  GridTriangle t;
  for (GridPoint& p : t)
    p = on_grid({random.uniform(-10, kGridWidth + 10), random.uniform(-10, kGridHeight + 10)});
  return t;
}

TEST(Raster, CoversTheSamplesInsideTheTriangleAndNoOthers) {
  Random random(1);
  int decided = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const GridTriangle t = random_triangle(random);
    const bool faces_us = twice_area(t) > 0;
    const List<int> counts = counts_of({t});
    Eigen::Matrix3d corners;  // the sample as a weighted mean of the corners: a linear system
    for (int k = 0; k < 3; ++k)
      corners.col(k) << static_cast<double>(t[static_cast<std::size_t>(k)].x) / kSubSteps,
          static_cast<double>(t[static_cast<std::size_t>(k)].y) / kSubSteps, 1.0;
    for (int y = 0; y < kGridHeight; ++y)
      for (int x = 0; x < kGridWidth; ++x) {
        const Vector3d w = corners.inverse() * Vector3d(x + 0.5, y + 0.5, 1.0);
        if (std::abs(w.minCoeff()) < 1e-7) continue;  // on an edge
        ++decided;
        ASSERT_EQ(counts[y * kGridWidth + x], faces_us && w.minCoeff() > 0.0 ? 1 : 0) << trial;
      }
  }
  EXPECT_GT(decided, 300 * kGridWidth * kGridHeight * 9 / 10);
}

TEST(Raster, WeightsAreThoseOfTheSampleInTheTriangle) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const GridTriangle t = random_triangle(random);
    for_each_sample(t, kGridWidth, kGridHeight, [&](int x, int y, const Vector3d& w) {
      double u = 0.0, v = 0.0;
      for (int k = 0; k < 3; ++k) {
        u += w[k] * static_cast<double>(t[static_cast<std::size_t>(k)].x) / kSubSteps;
        v += w[k] * static_cast<double>(t[static_cast<std::size_t>(k)].y) / kSubSteps;
      }
      ASSERT_NEAR(u, x + 0.5, 1e-9);
      ASSERT_NEAR(v, y + 0.5, 1e-9);
      ASSERT_NEAR(w.sum(), 1.0, 1e-12);
    });
  }
}

TEST(Raster, TrianglesThatShareEdgesCoverEverySampleOnce) {
  // A fan around a sample whose spokes and rim cross samples: every kind of tie.
  const GridPoint middle{20 * kSubSteps + 128, 15 * kSubSteps + 128};
  const int x0 = 8, x1 = 32, y0 = 4, y1 = 26;
  List<GridPoint> rim;  // clockwise on the picture, every sample of the rectangle's edge
  const auto at = [](int x, int y) { return GridPoint{x * kSubSteps + 128, y * kSubSteps + 128}; };
  for (int x = x0; x < x1; ++x) rim.push_back(at(x, y0));
  for (int y = y0; y < y1; ++y) rim.push_back(at(x1, y));
  for (int x = x1; x > x0; --x) rim.push_back(at(x, y1));
  for (int y = y1; y > y0; --y) rim.push_back(at(x0, y));
  List<GridTriangle> fan;
  for (int k = 0; k < rim.count(); ++k) fan.push_back({middle, rim[k], rim[(k + 1) % rim.count()]});
  const List<int> counts = counts_of(fan);
  for (int y = 0; y < kGridHeight; ++y)
    for (int x = 0; x < kGridWidth; ++x)  // upper and left edges belong to it, lower and right ones do not
      ASSERT_EQ(counts[y * kGridWidth + x], x >= x0 && x < x1 && y >= y0 && y < y1 ? 1 : 0) << x << ' ' << y;
}

TEST(Raster, HandlesBackFacingAndHugeTriangles) {
  EXPECT_EQ(counts_of({{on_grid({5, 5}), on_grid({5, 20}), on_grid({20, 5})}}),
            List<int>(kGridWidth * kGridHeight, 0));
  EXPECT_EQ(counts_of({{on_grid({-1e9, -1e9}), on_grid({1e9, -1e9}), on_grid({0, 1e9})}}),
            List<int>(kGridWidth * kGridHeight, 1));
}

}  // namespace
}  // namespace mimicx::render
