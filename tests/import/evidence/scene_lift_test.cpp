// The height of a motion over its scene.
#include "import/evidence/scene_lift.h"

#include <gtest/gtest.h>

#include "motion/raised_clip.h"
#include "motion/synthetic_clip.h"

namespace mimicx::import {
namespace {

motion::Clip shifted(motion::Clip clip, double up) {
  for (Vector3d& trans : clip.trans) trans.z() += up;
  return clip;
}

TEST(SceneLift, PutsFeetOnThePlateWhateverTheHeightOfTheFile) {
  const motion::Clip clip = test::raised(test::synthetic_clip("walk", 3));
  EXPECT_EQ(scene_lift(clip), 0.0);
  for (const double off : {-0.9, -0.15, 0.4}) EXPECT_NEAR(scene_lift(shifted(clip, off)), -off, 0.02) << off;
}

// A chair beside the feet, at another height, is no ground for them.
TEST(SceneLift, FeetOnTheFloorStayThere) {
  motion::Clip clip = test::synthetic_clip("squat", 3);
  clip.scene.plates = {{{clip.trans[0].x(), clip.trans[0].y() + 0.5}, 0.0, {0.25, 0.2}, 0.45}};
  EXPECT_EQ(scene_lift(clip), 0.0);
  EXPECT_NEAR(scene_lift(shifted(clip, 0.3)), -0.3, 0.02);
  clip.scene.plates.clear();
  EXPECT_EQ(scene_lift(shifted(clip, 0.3)), 0.0);
}

}  // namespace
}  // namespace mimicx::import
