#include "motion/prepare/floor_correction.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/prepare/damaged_motions.h"

namespace mimicx::motion {
namespace {

TEST(FloorCorrection, StaticShiftPutsTheSupportOnTheFloor) {
  for (const double height : {0.8, -0.3, 5.0}) {
    const FloorCorrection f = floor_correction(std::vector<double>(60, height), 30.0);
    EXPECT_NEAR(f.shift, -height, 1e-12);
    for (const double h : f.height) EXPECT_NEAR(h, -height, 1e-12);
  }
}

TEST(FloorCorrection, JumpsKeepTheirHeight) {
  for (const double speed : {1.5, 2.5, 3.5}) {
    const std::vector<double> z = test::jump_heights(90, speed);
    for (const double h : floor_correction(z, 30.0).height) EXPECT_NEAR(h, 0.0, 0.002) << speed;
  }
}

TEST(FloorCorrection, RemovesSlowDriftEvenDuringAJump) {
  std::vector<double> z = test::jump_heights(150, 2.5), drift;
  for (std::size_t t = 0; t < z.size(); ++t) {
    drift.push_back(0.07 + 0.04 * std::sin(2 * test::kPi * static_cast<double>(t) / 150.0));
    z[t] += drift[t];
  }
  const FloorCorrection f = floor_correction(z, 30.0);
  // Within a window of the ends the support is seen from one side only.
  for (std::size_t t = 0; t < z.size(); ++t)
    EXPECT_NEAR(f.height[t], -drift[t], t < 18 || t > 131 ? 0.03 : 0.015) << t;
}

TEST(FloorCorrection, NothingStaysDeeperThanTenMillimetres) {
  Random random(2, {1});
  for (int n = 0; n < 20; ++n) {
    std::vector<double> z(100);
    for (double& v : z) v = 0.05 * random.normal() + (random.below(10) == 0 ? 0.3 * random.normal() : 0.0);
    const FloorCorrection f = floor_correction(z, 30.0);
    for (std::size_t t = 0; t < z.size(); ++t) EXPECT_GE(z[t] + f.height[t], -0.010 - 1e-12);
  }
}

TEST(FloorCorrection, IgnoresNoiseOfAFewMillimetres) {
  Random random(2, {2});
  std::vector<double> z(120);
  for (double& v : z) v = 0.002 * random.normal();
  const FloorCorrection f = floor_correction(z, 30.0);
  for (std::size_t t = 1; t < z.size(); ++t) EXPECT_LT(std::abs(f.height[t] - f.height[t - 1]), 0.0003);
}

// At 120 frames per second the body is lifted as slowly as at 30.
TEST(FloorCorrection, LiftIsAsGentleAtEveryRate) {
  const auto largest = [](double fps) {
    PerFrame<double> lowest(static_cast<std::size_t>(4.0 * fps), 0.0);
    lowest[lowest.count() / 2] = -0.04;
    const PerFrame<double> height = lift_over_floor(lowest, fps);
    double most = 0.0;
    for (int t = 1; t + 1 < height.count(); ++t)
      most = std::max(most, fps * fps * std::abs(height[t + 1] - 2.0 * height[t] + height[t - 1]));
    return most;
  };
  EXPECT_LT(largest(120.0), 1.5 * largest(30.0));
}

}  // namespace
}  // namespace mimicx::motion
