#include "motion/prepare/glitches.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/prepare/damaged_motions.h"

namespace mimicx::motion {
namespace {

TEST(Glitches, FlagsShortSpikesAndNothingElse) {
  const Clip clean = test::random_clip(6, 90, 0.3);
  const auto none = find_glitches(clean);
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{40, 41}, {40, 45}, {0, 2}, {88, 90}}) {
    const auto flagged = find_glitches(test::with_glitch(clean, from, to, 2.0));
    for (std::size_t t = 0; t < 90; ++t) EXPECT_EQ(flagged[t], t >= from && t < to) << t << " of " << from;
  }
}

TEST(Glitches, FlagsAFrameAtAnotherPlace) {
  Clip clip = test::random_clip(6, 90, 0.3);
  clip.trans[30].y() += 3.0;
  const auto flagged = find_glitches(clip);
  EXPECT_EQ(std::count(flagged.begin(), flagged.end(), true), 1);
  EXPECT_TRUE(flagged[30]);
}

// The pelvis is slower there than joints may be, but no body begins to move like that from rest.
TEST(Glitches, FlagsAnEndThatHangsInTheAir) {
  const Clip clean = test::standing_clip(60, 1.0);
  Clip end = clean, start = clean;
  for (std::size_t t = 57; t < 60; ++t) end.trans[t].z() += 0.235;
  for (std::size_t t = 0; t < 3; ++t) start.trans[t].z() += 0.235;
  const auto at_end = find_glitches(end), at_start = find_glitches(start);
  for (std::size_t t = 0; t < 60; ++t) {
    EXPECT_EQ(at_end[t], t >= 57) << t;
    EXPECT_EQ(at_start[t], t < 3) << t;
  }
}

TEST(Glitches, DoesNotFlagFastMotionsOrLastingChanges) {
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
