#include "motion/prepare/arm_separation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/prepare/prepare.h"
#include "motion/segment_distance.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

Clip standing() { return test::synthetic_clip("stand", 501, 60); }

/// The left arm swings into the trunk and out of it again, as an estimator may leave it.
Clip with_arm_inside(Clip clip, double turn) {
  for (int t = 15; t < 45; ++t)
    clip.rotations[t][kLeftShoulder] = clip.rotations[30][kLeftShoulder] + Vector3d(0, -0.35 * turn, -turn);
  return clip;
}

Reference prepared(const Clip& clip, bool separate) {
  PreparationConfig config;
  config.separate = separate;
  return prepare_reference(clip, config, nullptr);
}

/// Largest overlap of a pair with an arm, m, from the capsules' axes.
double deepest(const Reference& reference) {
  double deepest = 0.0;
  for (const BodyPoses& poses : reference.poses)
    for (const auto& [a, b] : reference.character.self_pairs) {
      if (kLimbOf[a] < 3 && kLimbOf[b] < 3) continue;
      const Capsule &A = reference.character.capsule[a], &B = reference.character.capsule[b];
      const auto world = [&](int body, const Vector3d& p_B) -> Vector3d {
        return poses.p_WB[body] + poses.q_WB[body] * p_B;
      };
      const double distance =
          segment_distance(world(a, A.a_B), world(a, A.b_B), world(b, B.a_B), world(b, B.b_B));
      deepest = std::max(deepest, A.radius + B.radius - distance);
    }
  return deepest;
}

TEST(Separation, MovesAnArmOutOfTheTrunk) {
  const Clip clip = with_arm_inside(standing(), 0.45);
  const Reference inside = prepared(clip, false), outside = prepared(clip, true);
  ASSERT_GT(deepest(inside), 0.08);
  EXPECT_LT(deepest(outside), kAllowedOverlap + 0.01);  // a soft bound: the way there is smooth, too
  for (int t = 0; t < inside.size(); ++t)               // only shoulders and elbows turn
    for (int body = 0; body < kBodies; ++body)
      if (body != kLeftShoulder && body != kLeftElbow && body != kRightShoulder && body != kRightElbow) {
        EXPECT_EQ(inside.frames[t].q[body].coeffs(), outside.frames[t].q[body].coeffs()) << t << " " << body;
      }
}

TEST(Separation, MovesTheArmHardlyFartherThanItsDepth) {
  Reference reference = prepared(with_arm_inside(standing(), 0.45), false);
  const double depth = deepest(reference), moved = separate_arms(reference);
  EXPECT_GT(moved, depth - kAllowedOverlap - 0.005);  // no arm comes out without moving as far
  EXPECT_LT(moved, 3.0 * (depth - kAllowedOverlap));
}

// The elbow is 3 cm beside the trunk's axis and goes by 2 mm a frame from its front to its back: the nearest
// way out changes with it.
TEST(Separation, AnElbowDeepInsideDoesNotJumpFromFrontToBack) {
  Clip clip = standing();
  for (int t = 0; t < clip.frames(); ++t)
    clip.rotations[t][kLeftShoulder] =
        log_map(exp_map(Vector3d(0, 0, -2.1)) * exp_map(Vector3d(0, -0.5 + 0.5 * t / 59.0, 0)));
  Reference reference = prepared(clip, false);
  const auto elbow = [&](int t) -> Vector3d {
    const BodyPoses& pose = reference.poses[t];
    return pose.q_WB[kSpine3].conjugate() * (pose.p_WB[kLeftElbow] - pose.p_WB[kSpine3]);
  };
  separate_arms(reference);
  double fastest = 0.0;
  for (int t = 0; t + 1 < clip.frames(); ++t) fastest = std::max(fastest, (elbow(t + 1) - elbow(t)).norm());
  EXPECT_LT(fastest, 0.015);
}

// As soon as an overlap is gone nothing holds the arm outside: whole steps would jump in and out of it for
// ever.
TEST(Separation, EndsOutsideFromEveryDepth) {
  for (double turn = 0.2; turn < 0.47; turn += 0.02) {  // farther in, the arm is past the middle of the trunk
    Reference reference = prepared(with_arm_inside(standing(), turn), false);
    const double depth = deepest(reference), moved = separate_arms(reference);
    EXPECT_LT(deepest(reference), kAllowedOverlap + 0.01) << turn;
    EXPECT_LT(moved, 3.5 * std::max(depth - kAllowedOverlap, 0.01)) << turn;
  }
}

TEST(Separation, ReferenceWithoutOverlapStaysByteIdentical) {
  const Clip clip = standing();
  const Reference without = prepared(clip, false), with = prepared(clip, true);
  ASSERT_LT(deepest(without), kAllowedOverlap);
  for (int t = 0; t < without.size(); ++t)
    for (int body = 0; body < kBodies; ++body)
      EXPECT_EQ(without.frames[t].q[body].coeffs(), with.frames[t].q[body].coeffs());
}

// A forearm that is 30 mm deep in the pelvis all the time: the first frame is free, later ones are left
// alone.
TEST(Separation, StartsWithoutAnOverlap) {
  Clip clip = standing();
  for (auto& frame : clip.rotations) frame[kLeftShoulder] += 0.3 * Vector3d(0, -0.35, -1);
  Reference reference = prepared(clip, false);
  const auto deepest_at = [](Reference r, int t) {
    r.poses = {r.poses[t]};
    return deepest(r);
  };
  ASSERT_GT(deepest_at(reference, 0), 0.015);
  ASSERT_LT(deepest(reference), kAllowedOverlap);
  const Reference before = reference;
  EXPECT_GT(separate_arms(reference), 0.01);
  EXPECT_LT(deepest_at(reference, 0), 0.004);
  for (int t = 25; t < reference.size(); ++t)
    for (int body = 0; body < kBodies; ++body)
      EXPECT_LT((reference.poses[t].p_WB[body] - before.poses[t].p_WB[body]).norm(), 0.002) << t;
}

TEST(Separation, ElbowsStayHinges) {
  const Reference reference = prepared(with_arm_inside(standing(), 0.45), true);
  for (const ReferenceFrame& frame : reference.frames) {
    const Vector3d turn = log_map(frame.q[kLeftElbow]);
    EXPECT_LT(turn.cross(hinge_axis(kLeftElbow)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace mimicx::motion
