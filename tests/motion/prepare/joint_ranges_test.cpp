// Joints beyond their ranges are turned inside, smoothly, and nothing else changes.
#include "motion/prepare/joint_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "character/joint_range.h"
#include "core/units.h"
#include "motion/prepare/prepare.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

constexpr int kFrom = 20, kTo = 40,
              kAroundFrames = 10;  ///< frames beyond the range, and those that may change

double excess(const Reference& reference, int body, int t) {
  return range_distance(reference.character.joint[body], body, reference.frames[t].q[body]).excess;
}

double largest_excess(const Reference& reference) {
  double largest = -10.0;
  for (int t = 0; t < reference.size(); ++t)
    for (int body = 1; body < kBodies; ++body) largest = std::max(largest, excess(reference, body, t));
  return largest;
}

/// A standing motion of which a joint leaves its range and comes back, as fast as a minimum-jerk movement.
Reference turned(int body, const Vector3d& turn) {
  Reference reference = prepare_reference(test::synthetic_clip("stand", 501, 60), {}, nullptr);
  for (int t = kFrom; t < kTo; ++t) {
    const double s = std::sin(M_PI * (t - kFrom) / (kTo - 1 - kFrom));
    reference.frames[t].q[body] = reference.frames[t].q[body] * exp_map(s * turn);
  }
  return reference;
}

TEST(JointRanges, TurnsEveryJointInside) {
  for (int body = 1; body < kBodies; ++body) {
    const double side = is_right(body) ? -1.0 : 1.0;
    const Vector3d turn = is_hinge(body) ? Vector3d(-0.9 * hinge_axis(body))
                                         : Vector3d(2.2 * Vector3d(0.3, side, -0.2 * side).normalized());
    Reference reference = turned(body, turn);
    ASSERT_GT(largest_excess(reference), 3.0 * kDegree) << body;
    const RangeReport report = turn_into_ranges(reference);
    EXPECT_LE(largest_excess(reference), 1e-9) << body;
    EXPECT_GT(report.frames, 3) << body;
    EXPECT_LE(report.frames, kTo - kFrom) << body;
  }
}

TEST(JointRanges, ReportsTheFarthestJoint) {
  Reference reference = turned(kLeftHip, Vector3d(0.0, 2.2, 0.0));
  double farthest = 0.0;
  int frames = 0;
  for (int t = 0; t < reference.size(); ++t) {
    farthest = std::max(farthest, excess(reference, kLeftHip, t));
    frames += excess(reference, kLeftHip, t) > 0.0 ? 1 : 0;
  }
  const RangeReport report = turn_into_ranges(reference);
  EXPECT_EQ(report.body, kLeftHip);
  EXPECT_EQ(report.frames, frames);
  EXPECT_DOUBLE_EQ(report.farthest, farthest);
}

// The second differences of the correction stay within what its size and the time for it need.
TEST(JointRanges, CorrectionIsSmoothAndHardlyLargerThanTheExcess) {
  const Reference before = turned(kLeftHip, Vector3d(0.0, 1.4, 0.0));
  Reference after = before;
  const RangeReport report = turn_into_ranges(after);
  const auto correction = [&](int t) {
    return log_map(before.frames[t].q[kLeftHip].conjugate() * after.frames[t].q[kLeftHip]);
  };
  double largest = 0.0, bend = 0.0;
  for (int t = 1; t + 1 < before.size(); ++t) {
    largest = std::max(largest, correction(t).norm());
    bend = std::max(bend, (correction(t - 1) - 2.0 * correction(t) + correction(t + 1)).norm());
  }
  EXPECT_GT(largest, report.farthest);
  EXPECT_LT(largest, 1.5 * report.farthest);  // a chord, which is shorter than the turn
  EXPECT_LT(bend, 6.0 * kDegree);
}

TEST(JointRanges, OnlyFramesNearTheExcessChange) {
  const Reference before = turned(kLeftHip, Vector3d(0.0, 2.2, 0.0));
  Reference after = before;
  turn_into_ranges(after);
  for (int t = 0; t < before.size(); ++t) {
    const bool far = t < kFrom - kAroundFrames || t >= kTo + kAroundFrames;
    for (int body = 0; body < kBodies; ++body)
      if (far || body != kLeftHip) {
        EXPECT_EQ(before.frames[t].q[body].coeffs(), after.frames[t].q[body].coeffs()) << t << " " << body;
      }
  }
}

// A spine that bends too far in its lowest joint bends in the next one instead; the chest keeps its
// direction.
TEST(JointRanges, JointsBelowTakeOverWhatAJointCannotDo) {
  Reference before = turned(kSpine1, Vector3d(1.4, 0.0, 0.0));
  for (int t = 0; t < before.size(); ++t)
    before.poses[t] = forward_kinematics(before.character, before.frames[t].p_root, before.frames[t].q);
  ASSERT_GT(largest_excess(before), 10.0 * kDegree);
  Reference after = before;
  turn_into_ranges(after);
  EXPECT_LE(largest_excess(after), 1e-9);
  for (int t = 0; t < before.size(); ++t) {
    const BodyPoses now = forward_kinematics(after.character, after.frames[t].p_root, after.frames[t].q);
    EXPECT_LT(angle_between(now.q_WB[kSpine2], before.poses[t].q_WB[kSpine2]), 1e-9) << t;
    EXPECT_LT((now.p_WB[kHead] - before.poses[t].p_WB[kHead]).norm(), 0.08) << t;
  }
}

TEST(JointRanges, ExactMotionsStayByteIdentical) {
  PreparationConfig without;
  without.ranges = false;
  for (const char* kind : {"walk", "jump", "kick", "squat", "dance", "crouch", "stretch"}) {
    const Clip clip = test::synthetic_clip(kind, 3);
    PreparationReport report;
    const Reference a = prepare_reference(clip, without, nullptr), b = prepare_reference(clip, {}, &report);
    EXPECT_EQ(report.range_frames, 0) << kind;
    for (int t = 0; t < a.size(); ++t)
      for (int body = 0; body < kBodies; ++body)
        ASSERT_EQ(a.frames[t].q[body].coeffs(), b.frames[t].q[body].coeffs()) << kind;
  }
}

TEST(JointRanges, PreparationTellsHowFarAndInHowManyFrames) {
  Clip clip = test::synthetic_clip("stand", 501, 60);
  for (auto& frame : clip.rotations)
    frame[kRightHip] = log_map(exp_map(frame[kRightHip]) * exp_map({0.0, -1.8, 0.0}));
  PreparationReport report;
  const Reference reference = prepare_reference(clip, {}, &report);
  EXPECT_EQ(report.range_frames, 60);
  EXPECT_GT(report.range_deg, 5.0);
  EXPECT_LE(largest_excess(reference), 1e-9);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.front().find("right hip"), std::string::npos) << report.notes.front();
  EXPECT_NE(report.notes.front().find("60 frames"), std::string::npos) << report.notes.front();
}

}  // namespace
}  // namespace mimicx::motion
