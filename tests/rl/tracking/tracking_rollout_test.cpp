#include "rl/tracking/tracking_rollout.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/units.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::rl::tracking {
namespace {

TEST(TrackingRollout, FollowsAStandingReferenceAndReportsItsForces) {
  TrackingConfig config;
  const auto clip = make_tracking_clip(swaying_reference(16), config);
  const TrackingRollout rollout = roll_out(
      clip, config, [](int, const float*, float* action) { std::fill(action, action + kDofs, 0.0F); });
  ASSERT_EQ(rollout.poses.size(), 16U);
  EXPECT_FALSE(rollout.broken);
  EXPECT_LT(rollout.worst_distance, 0.15);
  double vertical = 0.0;  // mean over the last frames: the floor carries the weight
  for (std::size_t t = 8; t < 16; ++t)
    for (const Vector6d& wrench : rollout.forces[t].ground) vertical += wrench[5] / 8.0;
  const double weight = clip->reference.character.total_mass() * kGravity;
  EXPECT_NEAR(vertical, weight, 0.25 * weight);
}

TEST(TrackingRollout, StaysWithItsClipToTheLimitOfSuccessAndNotIfItBroke) {
  TrackingRollout rollout;
  rollout.mean_reward = 1.0;
  rollout.worst_distance = 0.5;
  EXPECT_TRUE(stays_with_clip(rollout));
  rollout.worst_distance = 0.51;
  EXPECT_FALSE(stays_with_clip(rollout));
  rollout.worst_distance = 0.1;
  rollout.broken = true;
  EXPECT_FALSE(stays_with_clip(rollout));
}

// The policy's state counts heights from the ground: everything on a plate of 0.25 m, and it acts as on the
// floor.
TEST(TrackingRollout, PolicyActsOnAPlateAsOnTheFloor) {
  const motion::Reference low = swaying_reference(16), high = on_a_plate(low);
  AgentShape shape;
  shape.observation_dim = kStateSize;
  shape.action_dim = kDofs;
  shape.hidden = {32};
  shape.last_scale = 0.3F;
  const auto act = mean_action({make_agent(shape, 5)});
  const TrackingRollout floor = roll_out(make_tracking_clip(low, {}), {}, act),
                        plate = roll_out(make_tracking_clip(high, {}), {}, act);
  ASSERT_EQ(plate.poses.size(), floor.poses.size());
  double moved = 0.0;
  for (std::size_t t = 0; t < floor.poses.size(); ++t)
    for (int body = 0; body < kBodies; ++body) {
      const Vector3d on_floor = floor.poses[t].p_WB[body], on_plate = plate.poses[t].p_WB[body];
      EXPECT_LT((on_plate - on_floor - Vector3d(0.0, 0.0, 0.25)).norm(), 2e-4) << t << ' ' << body;
      moved = std::max(moved, (on_floor - low.poses[t].p_WB[body]).norm());
    }
  EXPECT_GT(moved, 0.01);
}

}  // namespace
}  // namespace mimicx::rl::tracking
