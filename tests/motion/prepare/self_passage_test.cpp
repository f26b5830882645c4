// Limbs that pass through the body are led around it, smoothly, and nothing else changes.
#include "motion/prepare/self_passage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/passing_hand.h"
#include "motion/prepare/arm_separation.h"
#include "motion/prepare/prepare.h"
#include "motion/segment_distance.h"

namespace mimicx::motion {
namespace {

Reference unrepaired(const Clip& clip) {
  PreparationConfig config;
  config.separate = false;
  return prepare_reference(clip, config, nullptr);
}

const Reference& passing_hand() {
  static const Reference reference = unrepaired(test::clip_with_passing_hand());
  return reference;
}

/// Overlap of a body's capsule with the head's in a frame, m.
double overlap_with_head(const Reference& reference, int body, int t) {
  const BodyPoses& poses = reference.poses[t];
  const Capsule &A = reference.character.capsule[body], &B = reference.character.capsule[kHead];
  const auto world = [&](int b, const Vector3d& p_B) -> Vector3d {
    return poses.p_WB[b] + poses.q_WB[b] * p_B;
  };
  return A.radius + B.radius -
         segment_distance(world(body, A.a_B), world(body, A.b_B), world(kHead, B.a_B), world(kHead, B.b_B));
}

double deepest_in_head(const Reference& reference, int body) {
  double deepest = 0.0;
  for (int t = 0; t < reference.size(); ++t)
    deepest = std::max(deepest, overlap_with_head(reference, body, t));
  return deepest;
}

Vector3d hand(const Reference& reference, int t) {
  return test::arm_places(reference.character, reference.poses[t]).hand;
}

TEST(SelfPassage, LeadsAHandAroundTheHead) {
  Reference reference = passing_hand();
  ASSERT_GT(deepest_in_head(reference, kRightWrist), 0.1);
  const PassageReport report = lead_limbs_around(reference);
  EXPECT_EQ(report.passages, 1);
  EXPECT_EQ(report.remaining, 0);
  EXPECT_EQ(report.limb_body, kRightWrist);
  EXPECT_EQ(report.obstacle, kHead);
  EXPECT_NEAR(report.first_frame, test::kPassageFrom, 3);
  for (int body : {kRightWrist, kRightElbow, kLeftWrist})
    EXPECT_LT(deepest_in_head(reference, body), 0.03) << body;
  // It begins in front of the head and ends behind it.
  EXPECT_GT(hand(reference, test::kPassageFrom - 2).z(), 0.1);
  EXPECT_LT(hand(reference, test::kPassageTo + 2).z(), -0.1);
  EXPECT_EQ(lead_limbs_around(reference).passages, 0);  // nothing is left
}

// Of a motion that is long, or very wrong, too: what is not led around is counted.
TEST(SelfPassage, WhatIsLeftIsCounted) {
  constexpr int kCrossings = 88, kFrames = 10;
  Clip clip = test::clip_with_passing_hand();
  Clip many = clip;
  many.rotations.clear();
  many.trans.clear();
  for (int k = 0; k < kCrossings; ++k)
    for (int t = 0; t < kFrames; ++t) {  // through the head and back again
      const int at = test::kPassageFrom + (k % 2 == 0 ? t : kFrames - t);
      many.rotations.push_back(clip.rotations[at]);
      many.trans.push_back(clip.trans[at]);
    }
  Reference reference = unrepaired(many);
  const PassageReport first = lead_limbs_around(reference), again = lead_limbs_around(reference);
  EXPECT_GT(first.passages, 40);
  EXPECT_GE(first.remaining, again.passages);
}

// Separation alone leaves it as deep in the head as contact may be.
TEST(SelfPassage, SeparationAloneLeavesTheHandInTheHead) {
  Reference reference = passing_hand();
  separate_arms(reference);
  EXPECT_GT(deepest_in_head(reference, kRightWrist), 0.9 * kAllowedOverlap);
}

TEST(SelfPassage, GoesHardlyFartherThanTheHeadIsWide) {
  const Reference before = passing_hand();
  Reference after = before;
  const PassageReport report = lead_limbs_around(after);
  EXPECT_LT(report.moved, 0.13);
  double bend = 0.0;
  const auto shift = [&](int t) -> Vector3d { return hand(after, t) - hand(before, t); };
  for (int t = 1; t + 1 < before.size(); ++t)
    bend = std::max(bend, (shift(t - 1) - 2.0 * shift(t) + shift(t + 1)).norm());
  EXPECT_LT(bend, 0.01);  // m per frame²: 9 m/s²
}

TEST(SelfPassage, OnlyTheArmChangesAndOnlyAroundThePassage) {
  const Reference before = passing_hand();
  Reference after = before;
  lead_limbs_around(after);
  for (int t = 0; t < before.size(); ++t) {
    const bool far = t < test::kPassageFrom - 18 || t > test::kPassageTo + 18;
    for (int body = 0; body < kBodies; ++body)
      if (far || (body != kRightShoulder && body != kRightElbow)) {
        EXPECT_EQ(before.frames[t].q[body].coeffs(), after.frames[t].q[body].coeffs()) << t << " " << body;
      }
  }
}

TEST(SelfPassage, ForearmStaysAHinge) {
  Reference reference = passing_hand();
  lead_limbs_around(reference);
  for (const ReferenceFrame& frame : reference.frames)
    EXPECT_LT(log_map(frame.q[kRightElbow]).cross(hinge_axis(kRightElbow)).norm(), 1e-9);
}

/// Largest shift of the hand along each axis of the head.
Vector3d largest_shift(const Reference& before, const Reference& after) {
  Vector3d largest = Vector3d::Zero();
  for (int t = 0; t < before.size(); ++t)
    largest = largest.cwiseMax((hand(after, t) - hand(before, t)).cwiseAbs());
  return largest;
}

// Without a camera the hand goes over the top of the head. A camera in front that saw it beside the head
// leads it there.
TEST(SelfPassage, KeypointsChooseTheSide) {
  const Reference blind = passing_hand();
  Reference seen = blind, unseen = blind;
  const Vector3d back = blind.poses[test::kPassageFrom].q_WB[kHead] * -Vector3d::UnitZ();
  seen.keypoints = test::seen_along(unrepaired(test::clip_with_passing_hand(0.16)).poses, back);
  EXPECT_EQ(lead_limbs_around(seen).remaining, 0);
  EXPECT_EQ(lead_limbs_around(unseen).remaining, 0);
  const Vector3d by_sight = largest_shift(blind, seen), without = largest_shift(blind, unseen);
  EXPECT_GT(by_sight.x(), 1.4 * without.x());
  EXPECT_LT(by_sight.y(), without.y());
  EXPECT_LT(deepest_in_head(seen, kRightWrist), 0.04);
}

TEST(SelfPassage, KeypointsOfAMotionThatIsNotFittedToThemChooseNothing) {
  Clip clip = test::clip_with_passing_hand();
  const Reference blind = prepare_reference(clip, {}, nullptr);
  const PerFrame<BodyPoses> others = poses_of(test::clip_with_passing_hand(0.16));
  clip.keypoints = test::seen_along(others, others[test::kPassageFrom].q_WB[kHead] * -Vector3d::UnitZ());
  const Reference unfitted = prepare_reference(clip, {}, nullptr);
  for (int t = 0; t < blind.size(); ++t)
    for (const int body : {kRightShoulder, kRightElbow})
      ASSERT_EQ(unfitted.frames[t].q[body].coeffs(), blind.frames[t].q[body].coeffs()) << t;
}

TEST(SelfPassage, ExactMotionsStayByteIdentical) {
  for (const char* kind : {"walk", "jump", "kick", "wave", "dance", "punch", "walk_turn", "lunge"}) {
    const Reference before = unrepaired(test::synthetic_clip(kind, 3));
    Reference after = before;
    EXPECT_EQ(lead_limbs_around(after).passages, 0) << kind;
    for (int t = 0; t < before.size(); ++t)
      for (int body = 0; body < kBodies; ++body)
        ASSERT_EQ(before.frames[t].q[body].coeffs(), after.frames[t].q[body].coeffs()) << kind;
  }
}

TEST(SelfPassage, PreparationTellsOfPassages) {
  PreparationReport report;
  const Reference reference = prepare_reference(test::clip_with_passing_hand(), {}, &report);
  EXPECT_EQ(report.passages, 1);
  EXPECT_EQ(report.passages_left, 0);
  EXPECT_LT(deepest_in_head(reference, kRightWrist), kAllowedOverlap);
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
    return note.find("right wrist through head") != std::string::npos;
  }));
}

}  // namespace
}  // namespace mimicx::motion
