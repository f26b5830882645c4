#include "motion/resample.h"

#include <gtest/gtest.h>

#include "motion/full_clip.h"

namespace mimicx::motion {
namespace {

using test::clip_with_everything;

TEST(Resample, ConstantRotationAndTranslationStayOnTheirCurve) {
  const Vector3d axis = Vector3d(1, -2, 0.5).normalized(), velocity(0.3, -1.2, 0.1);
  Clip clip = test::standing_clip(121, 0.0, 120.0);
  for (std::size_t t = 0; t < 121; ++t) {
    clip.rotations[t][kSpine1] = 0.8 * static_cast<double>(t) / 120.0 * axis;
    clip.trans[t] = velocity * static_cast<double>(t) / 120.0;
  }
  for (const double fps : {30.0, 50.0, 25.0}) {
    const Clip out = resampled(clip, fps);
    EXPECT_EQ(out.fps, fps);
    ASSERT_EQ(out.frames(), static_cast<int>(fps) + 1);
    for (int k = 0; k < out.frames(); ++k) {
      EXPECT_LT((out.rotations[k][kSpine1] - 0.8 * k / fps * axis).norm(), 1e-9);
      EXPECT_LT((out.trans[k] - velocity * k / fps).norm(), 1e-9);
    }
  }
}

TEST(Resample, SameRateChangesNothing) {
  const Clip clip = test::clip_with_everything();
  const Clip out = resampled(clip, clip.fps);
  EXPECT_EQ(out.rotations, clip.rotations);
  EXPECT_EQ(out.passthrough.size(), clip.passthrough.size());
  EXPECT_TRUE(out.warnings.empty());
}

TEST(Resample, KeypointsAndMovingCamerasFollowAndPerFrameMembersAreNamedInAWarning) {
  Clip clip = test::clip_with_everything();
  clip.fps = 60.0;
  clip.keypoints->uvc[1][0] = {11.5, 22.25, 0.7};
  const Clip half = resampled(clip, 30.0), third = resampled(clip, 40.0);
  EXPECT_EQ(half.frames(), 3);
  EXPECT_EQ(half.keypoints->uvc.size(), 3u);
  EXPECT_EQ(half.keypoints->extrinsics.size(), 3u);
  EXPECT_TRUE(half.passthrough.empty());
  ASSERT_EQ(half.warnings.size(), 1u);
  EXPECT_NE(half.warnings[0].find("pose_hand"), std::string::npos);
  // At 40 fps frame 1 lies between the input's frames 1 and 2, midway.
  EXPECT_LT((third.keypoints->uvc[1][0] - Vector3d(11.0, 21.25, 0.7)).norm(), 1e-9);
  EXPECT_EQ(third.keypoints->uvc[1][1].z(), 0.0);
  EXPECT_NEAR(third.keypoints->extrinsics[2](0, 3), 4.5, 1e-9);
  EXPECT_LT((third.keypoints->extrinsics[1].topLeftCorner<3, 3>() - Matrix3d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace mimicx::motion
