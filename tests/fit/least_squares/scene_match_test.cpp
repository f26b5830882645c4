#include "fit/least_squares/scene_match.h"

#include <gtest/gtest.h>

namespace mimicx::fit {
namespace {

constexpr double kRise = 0.17, kTread = 0.3;

Scene stairs() {
  Scene scene;
  for (int step = 1; step <= 3; ++step)
    scene.plates.push_back({{kTread * (step - 0.5), 0.2}, 0.0, {0.5 * kTread, 0.6}, kRise * step});
  return scene;
}

/// One foot per step, from the floor up; each stands for ten frames and then swings on.
PerFrame<FootPositions> climb(const Vector3d& off) {
  PerFrame<FootPositions> feet(40);
  for (int t = 0; t < 40; ++t)
    for (int i = 0; i < kFootPoints; ++i) {
      const bool stands = t % 10 < 8;
      const int step = t / 10;
      const double ahead = 0.02 * (i % (kPointsPerFoot)) - 0.05;
      feet[t][i] = off + Vector3d(kTread * (step - 0.5) + ahead + (stands ? 0.0 : 0.15), 0.2, kRise * step);
    }
  return feet;
}

TEST(SceneShift, FindsWhereTheStairsAreUnderTheFeet) {
  for (const Vector3d& off :
       {Vector3d(0.24, 0.0, 0.0), Vector3d(-0.21, 0.5, 0.0), Vector3d(0.3, -0.1, 0.0)}) {
    const Eigen::Vector2d shift = scene_shift(climb(off), 30.0, stairs(), true);
    const Scene found = shifted(stairs(), shift);
    const PerFrame<FootPositions> feet = climb(off);
    for (int t = 0; t < feet.count(); ++t)
      if (t % 10 < 8) {
        EXPECT_EQ(found.height_under(feet[t][0], 1.0), feet[t][0].z()) << shift.transpose();
        EXPECT_EQ(found.height_under(feet[t][5], 1.0), feet[t][5].z()) << shift.transpose();
      }
  }
}

TEST(SceneShift, LetsAnUnsettledMotionHangOverTheScene) {
  const Eigen::Vector2d low = scene_shift(climb({0.24, 0.0, 0.0}), 30.0, stairs(), false),
                        high = scene_shift(climb({0.24, 0.0, 0.15}), 30.0, stairs(), false);
  EXPECT_GT(low.x(), 0.1);
  EXPECT_EQ(low, high);
}

TEST(SceneShift, IsZeroOnAFlatFloorAndWhereTheFeetStandOnTheSceneAlready) {
  EXPECT_EQ(scene_shift(climb({0.24, 0.0, 0.0}), 30.0, {}, true), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(scene_shift(climb(Vector3d::Zero()), 30.0, stairs(), true), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace mimicx::fit
