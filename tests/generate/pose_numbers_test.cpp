#include "generate/pose_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "motion/surface_points.h"

namespace mimicx::generate {
namespace {

/// A walk of sorts: everything moves, smoothly.
motion::Clip some_motion(const std::array<double, kBetas>& betas = {}) {
  const int frames = 20;
  PerFrame<Vector3d> p_root(frames);
  PerFrame<PerBody<Quaterniond>> q(frames);
  for (int t = 0; t < frames; ++t) {
    p_root[t] = {0.02 * t, 0.01 * t * t / frames, 0.9 + 0.001 * t};
    q[t][0] = rotation_z(3.0 + 0.05 * t) * exp_map({0.5 * std::numbers::pi, 0.01 * t, 0.0});
    for (int body = 1; body < kBodies; ++body) q[t][body] = exp_map({0.02 * t, 0.03 * body, -0.01 * t});
  }
  return motion::to_clip("some", 30.0, make_character(betas), p_root, q);
}

motion::Clip moved(motion::Clip clip, double angle, const Vector3d& by) {
  for (int t = 0; t < clip.frames(); ++t) {
    const Vector3d pelvis = clip.trans[t] + motion::rest_pelvis(clip);
    clip.trans[t] = rotation_z(angle) * pelvis + by - motion::rest_pelvis(clip);
    clip.rotations[t][0] = log_map(rotation_z(angle) * exp_map(clip.rotations[t][0]));
  }
  return clip;
}

TEST(PoseNumbers, AMotionComesBackButForPlaceAndHeading) {
  const motion::Clip clip = some_motion();
  const motion::Clip back = clip_of_numbers("back", pose_numbers(clip));
  const auto before = motion::poses_of(clip), after = motion::poses_of(back);
  ASSERT_EQ(after.count(), before.count());
  const double turn = heading_angle(after[0].q_WB[0]) - heading_angle(before[0].q_WB[0]);
  for (int t = 0; t < before.count(); ++t)
    for (int body = 0; body < kBodies; ++body) {
      const Vector3d from_start = before[t].p_WB[body] - before[0].p_WB[0];
      const Vector3d now = after[t].p_WB[body] - after[0].p_WB[0];
      EXPECT_LT((rotation_z(turn) * from_start - now).norm(), 1e-5) << t << ' ' << body;
    }
}

TEST(PoseNumbers, DependOnNeitherPlaceNorHeading) {
  const motion::Clip clip = some_motion();
  const nn::Matrix<float> moved_numbers = pose_numbers(moved(clip, 2.0, {3.0, -1.0, 0.0}));
  EXPECT_LT((pose_numbers(clip) - moved_numbers).cwiseAbs().maxCoeff(), 1e-5F);
  EXPECT_GT((pose_numbers(clip) - pose_numbers(moved(clip, 0.0, {0.0, 0.0, 0.1}))).cwiseAbs().maxCoeff(),
            0.09F);
}

TEST(PoseNumbers, AStandingBodyOfAnyLengthStandsOnTheFloor) {
  std::array<double, kBetas> tall{};
  tall[0] = 2.0;
  for (const auto& betas : {std::array<double, kBetas>{}, tall}) {
    const Character body = make_character(betas);
    PerFrame<Vector3d> p_root(3);
    PerFrame<PerBody<Quaterniond>> q(3);
    for (int t = 0; t < 3; ++t) {
      q[t].fill(Quaterniond::Identity());
      q[t][0] = exp_map({0.5 * std::numbers::pi, 0.0, 0.0});
      p_root[t] = {0.0, 0.0, -lowest_contact(body, forward_kinematics(body, Vector3d::Zero(), q[t]))};
    }
    const motion::Clip stand =
        clip_of_numbers("stand", pose_numbers(motion::to_clip("s", 30.0, body, p_root, q)));
    EXPECT_NEAR(lowest_contact(make_character(), motion::poses_of(stand)[1]), 0.0, 1e-5);
  }
}

TEST(PoseNumbers, RefusesOtherRates) {
  motion::Clip clip = some_motion();
  clip.fps = 60.0;
  EXPECT_THROW(pose_numbers(clip), DataError);
}

TEST(PoseNumbers, HatsOfTheConditionSumToOneAndFollowTheShare) {
  std::vector<float> row(static_cast<std::size_t>(condition_numbers(3)));
  for (const double share : {-0.1, 0.0, 0.33, 1.0, 1.2}) {
    write_condition(1, 3, share, 150, row.data());
    float sum = 0.0F, place = 0.0F;
    for (int k = 0; k < kHats; ++k) {
      const float weight = row[static_cast<std::size_t>(3 + k)];
      sum += weight;
      place += weight * static_cast<float>(k) / (kHats - 1);
    }
    EXPECT_NEAR(sum, 1.0F, 1e-6F);
    EXPECT_NEAR(place, std::clamp(share, 0.0, 1.0), 1e-6);
    EXPECT_EQ(row[0] + row[2], 0.0F);
    EXPECT_EQ(row[1], 1.0F);
    EXPECT_NEAR(row.back(), 0.5F, 1e-6F);
  }
}

}  // namespace
}  // namespace mimicx::generate
