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

}  // namespace
}  // namespace mimicx::rl::tracking
