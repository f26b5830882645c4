#include "picture/moments.h"

#include <gtest/gtest.h>

#include "motion/standing_clip.h"

namespace mimicx::picture {
namespace {

TEST(Moments, AreEvenlySpacedWithBothEnds) {
  EXPECT_EQ(even_moments({1.0, 3.0}, 5), (List<double>{1.0, 1.5, 2.0, 2.5, 3.0}));
  EXPECT_EQ(even_moments({1.0, 3.0}, 1), (List<double>{2.0}));
}

TEST(Moments, TellingMomentIsTheRaisedArmForAnyHeading) {
  motion::Clip clip = motion::standing_clip(40);
  for (int t = 0; t < 40; ++t) {
    clip.rotations[t][kPelvis] = log_map(rotation_z(0.2 * t) * exp_map(clip.rotations[t][kPelvis]));
    clip.trans[t].x() += 0.1 * t;
  }
  clip.rotations[23][kLeftShoulder] = Vector3d(0, 0, 1.2);
  const PosedMotion motion = posed_motion(clip, files::Skin::kShapes, std::nullopt);
  EXPECT_DOUBLE_EQ(telling_moment(motion, {0.0, motion.seconds()}), 23 / 30.0);
  EXPECT_LT(telling_moment(motion, {0.0, 0.5}), 0.51) << "of that stretch";
}

TEST(PosedMotion, ShowsTheNearestFrame) {
  const PosedMotion motion = posed_motion(motion::standing_clip(10), files::Skin::kShapes, std::nullopt);
  EXPECT_EQ(motion.seconds(), 0.3);
  EXPECT_EQ(motion.frame_at(-1.0), 0);
  EXPECT_EQ(motion.frame_at(0.116), 3);
  EXPECT_EQ(motion.frame_at(0.117), 4);
  EXPECT_EQ(motion.frame_at(9.0), 9);
}

}  // namespace
}  // namespace mimicx::picture
