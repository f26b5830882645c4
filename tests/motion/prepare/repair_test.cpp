#include "motion/prepare/repair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/prepare/damaged_motions.h"

namespace mimicx::motion {
namespace {

using test::jump_heights;
using test::kPi;
using test::with_glitch;

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

TEST(FloorCorrection, SlowDriftOfTheSupportIsRemovedUnderAJumpAsWell) {
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

TEST(FloorCorrection, NoiseOfAFewMillimetresIsNotFollowed) {
  Random random(2, {2});
  std::vector<double> z(120);
  for (double& v : z) v = 0.002 * random.normal();
  const FloorCorrection f = floor_correction(z, 30.0);
  for (std::size_t t = 1; t < z.size(); ++t) EXPECT_LT(std::abs(f.height[t] - f.height[t - 1]), 0.0003);
}

TEST(Glitches, ShortSpikesAreFlaggedAndNothingElse) {
  const Clip clean = test::random_clip(6, 90, 0.3);
  const auto none = find_glitches(clean);
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{40, 41}, {40, 45}, {0, 2}, {88, 90}}) {
    const auto flagged = find_glitches(test::with_glitch(clean, from, to, 2.0));
    for (std::size_t t = 0; t < 90; ++t) EXPECT_EQ(flagged[t], t >= from && t < to) << t << " of " << from;
  }
}

TEST(Glitches, ThrownPositionsAreFlagged) {
  Clip clip = test::random_clip(6, 90, 0.3);
  clip.trans[30].y() += 3.0;
  const auto flagged = find_glitches(clip);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 1);
  EXPECT_TRUE(flagged[30]);
}

TEST(Glitches, FastMotionsAndLastingChangesAreNotFlagged) {
  Clip kick =
      test::standing_clip(60, 1.0);  // the whole leg swings up to 30 rad/s and back in 0.4 s, smoothly
  for (std::size_t t = 20; t < 32; ++t)
    kick.rotations[t][kLeftHip].x() =
        -2.3 * std::pow(std::sin(test::kPi * static_cast<double>(t - 20) / 12.0), 2);
  const auto flagged = find_glitches(kick);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 0);
  Clip cut = test::random_clip(6, 90, 0.3);  // a cut in the video: jumps and stays
  for (std::size_t t = 45; t < 90; ++t) cut.trans[t].x() += 4.0;
  const auto after = find_glitches(cut);
  EXPECT_EQ(std::count(after.begin(), after.end(), true), 0);
}

TEST(Glitches, BridgingRestoresASmoothMotion) {
  const Clip clean = test::random_clip(6, 90, 0.3);
  Clip clip = test::with_glitch(clean, 40, 43, 2.0);
  bridge_glitches(clip, find_glitches(clip));
  for (std::size_t t = 0; t < 90; ++t)
    for (std::size_t j = 0; j < kBodies; ++j) {
      const double off = exp_map(clip.rotations[t][j]).angularDistance(exp_map(clean.rotations[t][j]));
      EXPECT_LT(off, t >= 40 && t < 43 ? 0.1 : 1e-7) << t;
    }
  Clip ends = test::with_glitch(clean, 0, 2, 2.0);
  bridge_glitches(ends, find_glitches(ends));
  EXPECT_EQ(ends.rotations[0], ends.rotations[1]);
  EXPECT_LT(exp_map(ends.rotations[0][5]).angularDistance(exp_map(clean.rotations[2][5])), 1e-7);
  Clip hopeless = clean;
  bridge_glitches(hopeless, PerFrame<bool>(90, true));
  EXPECT_EQ(hopeless.rotations, clean.rotations);
}

}  // namespace
}  // namespace mimicx::motion
