#include "import/retarget/retarget_floor.h"

#include <gtest/gtest.h>

#include "import/world_transform.h"
#include "motion/surface_points.h"

namespace mimicx::import {
namespace {

/// A person on all fours with straight arms, whose hands are in line with the forearms.
motion::Clip push_up(int frames) {
  motion::Clip clip;
  clip.fps = 30.0;
  for (int t = 0; t < frames; ++t) {
    auto& q = clip.rotations.emplace_back();
    q.fill(Vector3d::Zero());
    q[0] = log_map(exp_map(1.5 * Vector3d::UnitX()) * rotation_to_z_up('y'));
    q[kLeftShoulder] = {0.0, -1.5, 0.0};
    q[kRightShoulder] = {0.0, 1.5, 0.0};
    clip.trans.emplace_back(0.0, 0.0, 1.0);
  }
  const double wrist = motion::poses_of(clip)[0].p_WB[kLeftWrist].z();
  for (Vector3d& p : clip.trans) p.z() += 0.06 - wrist;
  return clip;
}

double lowest_of_hands(const motion::Clip& clip, int t) {
  std::vector<motion::SurfacePoint> hands;
  for (const motion::SurfacePoint& point : motion::surface_points(make_character(clip.usable_betas())))
    if (point.body == kLeftWrist || point.body == kRightWrist) hands.push_back(point);
  return motion::lowest_height(hands, motion::poses_of(clip)[t]);
}

TEST(RetargetFloor, HandsThatWereNotRecordedLieOnTheFloor) {
  const motion::Clip before = push_up(4);
  motion::Clip clip = before;
  ASSERT_LT(lowest_of_hands(clip, 0), -0.05);
  bend_hands(clip);
  for (int t = 0; t < clip.frames(); ++t) {
    EXPECT_GE(lowest_of_hands(clip, t), 0.0);
    EXPECT_LT(lowest_of_hands(clip, t), 0.005);
    for (int body = 0; body < kBodies; ++body)
      if (body != kLeftWrist && body != kRightWrist) {
        EXPECT_EQ(clip.rotations[t][body], before.rotations[t][body]);
      }
  }
  EXPECT_EQ(clip.decisions.size(), 1U);
}

TEST(RetargetFloor, HandsThatWereRecordedStayAsTheyAre) {
  motion::Clip clip = push_up(4);
  for (const int wrist : {kLeftWrist, kRightWrist}) clip.rotations[2][wrist].x() = 0.1;
  const motion::Clip before = clip;
  bend_hands(clip);
  for (int t = 0; t < clip.frames(); ++t) EXPECT_EQ(clip.rotations[t], before.rotations[t]);
}

}  // namespace
}  // namespace mimicx::import
