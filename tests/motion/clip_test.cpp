#include "motion/clip.h"

#include <gtest/gtest.h>

#include "motion/made_motions.h"

namespace mimicx::motion {
namespace {

TEST(Clip, PelvisIsTransPlusTheModelsRestPelvis) {
  Clip clip = test::random_clip(4, 5, 0.5);
  for (const char* model : {"mimicx", "smpl", "smplh", "smplx"}) {
    clip.body_model = model;
    EXPECT_LT((poses_of(clip)[1].p_WB[0] - (clip.trans[1] + mimicx::rest_pelvis(model))).norm(), 1e-12)
        << model;
  }
}

TEST(Clip, ToClipKeepsThePoses) {
  Random random(9, {1});
  const Character character = make_character({1, 0, -1, 0, 0, 0.5, 0, 0, 0, 0});
  PerFrame<Vector3d> p;
  PerFrame<test::Rotations> q(7);
  for (test::Rotations& frame : q) {
    p.push_back(test::random_vector(random));
    for (Quaterniond& joint : frame) joint = exp_map(0.5 * test::random_vector(random));
  }
  const Clip clip = to_clip("again", 24.0, character, p, q);
  EXPECT_EQ(clip.fps, 24.0);
  ASSERT_EQ(clip.frames(), 7);
  const auto poses = poses_of(clip);
  for (int t = 0; t < 7; ++t) {
    const BodyPoses expected = forward_kinematics(character, p[t], q[t]);
    for (int j = 0; j < kBodies; ++j) {
      EXPECT_LT((poses[t].p_WB[j] - expected.p_WB[j]).norm(), 1e-12) << kBodyNames[j];
      EXPECT_LT(poses[t].q_WB[j].angularDistance(expected.q_WB[j]), 1e-7) << kBodyNames[j];
    }
  }
}

}  // namespace
}  // namespace mimicx::motion
