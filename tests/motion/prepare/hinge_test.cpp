#include "motion/prepare/hinge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "motion/clip_file.h"
#include "motion/made_motions.h"

namespace mimicx::motion {
namespace {

using test::Rotations;

struct Limb {
  int upper, hinge, end;
};
constexpr Limb kLimbs[] = {{kLeftHip, kLeftKnee, kLeftAnkle},
                           {kRightHip, kRightKnee, kRightAnkle},
                           {kLeftShoulder, kLeftElbow, kLeftWrist},
                           {kRightShoulder, kRightElbow, kRightWrist}};

BodyPoses pose_of(const Character& c, const test::Rotations& q) {
  return forward_kinematics(c, Vector3d(0, 0, 1), q);
}

double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Bend of a limb: angle between its two bones in the world, rad.
double bend_of(const BodyPoses& p, const Limb& limb) {
  return angle(p.p_WB[limb.hinge] - p.p_WB[limb.upper], p.p_WB[limb.end] - p.p_WB[limb.hinge]);
}

test::Rotations random_rotations(Random& random, double amplitude) {
  test::Rotations q;
  for (Quaterniond& r : q) r = exp_map(amplitude * test::random_vector(random));
  return q;
}

TEST(Hinges, BentLimbsKeepBoneDirectionsAndEndOrientation) {
  Random random(1, {1});
  const Character c = make_character({1, 0, -1, 0, 1, 0, 0, 0, 0, 0.5});
  int bent = 0;
  for (int n = 0; n < 200; ++n) {
    const test::Rotations smpl = random_rotations(random, 0.7);
    const BodyPoses before = pose_of(c, smpl), after = pose_of(c, to_hinges(c, {smpl})[0]);
    for (const Limb& limb : kLimbs) {
      EXPECT_LT(before.q_WB[limb.end].angularDistance(after.q_WB[limb.end]), 1e-7);
      if (bend_of(before, limb) < 30.1 / 180 * test::kPi) continue;
      ++bent;
      EXPECT_LT((before.p_WB[limb.hinge] - after.p_WB[limb.hinge]).norm(), 1e-9);
      EXPECT_LT((before.p_WB[limb.end] - after.p_WB[limb.end]).norm(), 1e-9);
    }
  }
  EXPECT_GT(bent, 300);
}

TEST(Hinges, TurnAboutTheirAxisOnlyTowardsTheFlexingSide) {
  Random random(1, {2});
  const Character c = make_character();
  for (int n = 0; n < 200; ++n) {
    const test::Rotations q = to_hinges(c, {random_rotations(random, 0.7)})[0];
    for (const Limb& limb : kLimbs) {
      const Vector3d axis = hinge_axis(limb.hinge), r = log_map(q[limb.hinge]);
      EXPECT_LT(r.cross(axis).norm(), 1e-12);
      EXPECT_GT(r.dot(axis), -7.0 / 180 * test::kPi);
    }
  }
}

TEST(Hinges, OtherJointsAreUntouched) {
  Random random(1, {3});
  const test::Rotations smpl = random_rotations(random, 0.6), q = to_hinges(make_character(), {smpl})[0];
  for (const int body : {kPelvis, kSpine1, kSpine3, kLeftFoot, kHead, kLeftCollar})
    EXPECT_EQ(q[body].coeffs(), smpl[body].coeffs()) << kBodyNames[body];
}

TEST(Hinges, HingedMotionsStayUnchanged) {
  Random random(1, {4});
  for (int n = 0; n < 100; ++n) {
    test::Rotations q = random_rotations(random, 0.6);
    for (const Limb& limb : kLimbs)
      q[limb.hinge] = exp_map(random.uniform(-0.15, 2.6) * hinge_axis(limb.hinge));
    const test::Rotations out = to_hinges(make_character(), {q})[0];
    for (int i = 0; i < kBodies; ++i) EXPECT_LT(q[i].angularDistance(out[i]), 1e-7) << kBodyNames[i];
    const test::Rotations twice = to_hinges(make_character(), {out})[0];
    for (int i = 0; i < kBodies; ++i) EXPECT_LT(out[i].angularDistance(twice[i]), 1e-7);
  }
}

TEST(Hinges, NearlyHingedMotionsHardlyChange) {
  Random random(1, {5});
  const Character c = make_character();
  for (int n = 0; n < 100; ++n) {
    test::Rotations q = random_rotations(random, 0.6);
    for (const Limb& limb : kLimbs) {
      const Vector3d off = 1e-3 * test::random_vector(random);
      q[limb.hinge] = exp_map(off) * exp_map(random.uniform(0.1, 2.6) * hinge_axis(limb.hinge));
    }
    const test::Rotations out = to_hinges(c, {q})[0];
    for (const Limb& limb : kLimbs)
      EXPECT_LT(q[limb.upper].angularDistance(out[limb.upper]), 0.05) << kBodyNames[limb.hinge];
  }
}

TEST(Hinges, EndsStayInPlaceAndTheMotionIsContinuousThroughStraightLimbs) {
  const Character c = make_character();
  // A leg and an arm swing from bent through straight to slightly overstretched, beside a fixed tilt off
  // the hinge's axis, and back. 2000 frames: a jump would show as a large step.
  constexpr int kFrames = 2000;
  for (const Limb& limb : kLimbs)
    for (const double tilt : {-0.10, -0.03, 0.02, 0.08}) {
      const Vector3d axis = hinge_axis(limb.hinge);
      const Vector3d across =
          limb.end == kLeftAnkle || limb.end == kRightAnkle ? Vector3d::UnitZ() : Vector3d::UnitX();
      PerFrame<test::Rotations> smpl(kFrames);
      for (int t = 0; t < kFrames; ++t) {
        test::Rotations& q = smpl[t];
        q.fill(Quaterniond::Identity());
        const double flexion = 0.3 + 0.5 * std::cos(2 * test::kPi * t / kFrames);  // 46° … -11°
        q[limb.hinge] = exp_map(tilt * across) * exp_map(flexion * axis);
      }
      const PerFrame<test::Rotations> q = to_hinges(c, smpl);
      for (std::size_t t = 0; t < kFrames; ++t) {
        const BodyPoses before = pose_of(c, smpl[t]), after = pose_of(c, q[t]);
        // A limb cannot be straighter than its rest bones allow: 2 mm of reach at most.
        EXPECT_LT((before.p_WB[limb.end] - after.p_WB[limb.end]).norm(), 0.0021);
        EXPECT_LT((before.p_WB[limb.hinge] - after.p_WB[limb.hinge]).norm(), 0.045);
        if (t > 0) {
          for (const int body : {limb.upper, limb.hinge, limb.end})
            EXPECT_LT(q[t][body].angularDistance(q[t - 1][body]), 0.05)
                << kBodyNames[body] << " frame " << t << " tilt " << tilt;
        }
      }
    }
}

TEST(Hinges, LimbsBentBackwardsByNoiseDoNotTwist) {
  Random random(1, {6});
  const Character c = make_character();
  for (int n = 0; n < 100; ++n)
    for (const Limb& limb : kLimbs) {
      test::Rotations q = random_rotations(random, 0.4);
      q[limb.hinge] =
          exp_map(random.uniform(-0.2, 0.0) * hinge_axis(limb.hinge) + 0.05 * test::random_vector(random));
      const test::Rotations out = to_hinges(c, {q})[0];
      EXPECT_LT(q[limb.upper].angularDistance(out[limb.upper]), 1.0) << kBodyNames[limb.hinge];
    }
}

TEST(Hinges, ResidualOfRealMotionsIsUnderFiveMillimetresOnAverage) {
  namespace fs = std::filesystem;
  const fs::path motions = fs::path(MIMICX_SHARED_DIR) / "motions";
  if (!fs::exists(motions)) GTEST_SKIP() << "no folder of real motions here";
  const Character c = make_character();
  for (const char* folder : {"video", "amass"})
    for (const auto& entry : fs::directory_iterator(motions / folder)) {
      const auto smpl = joint_rotations(read_clip(entry.path()));
      const auto hinged = to_hinges(c, smpl);
      double sum = 0.0, end = 0.0;
      for (std::size_t t = 0; t < smpl.size(); ++t) {
        const BodyPoses before = pose_of(c, smpl[t]), after = pose_of(c, hinged[t]);
        for (int i = 0; i < kBodies; ++i) {
          const double e = (before.p_WB[i] - after.p_WB[i]).norm();
          sum += e / static_cast<double>(kBodies * smpl.size());
          if (!is_hinge(i)) end = std::max(end, e);
        }
      }
      EXPECT_LT(sum, 0.0015) << entry.path();  // mean over all joints
      EXPECT_LT(end, 0.0021) << entry.path();  // any joint but knees and elbows
    }
}

}  // namespace
}  // namespace mimicx::motion
