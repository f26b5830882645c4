// Eq. 1 on motions whose features are known in closed form, and what the features must not depend on.
#include "pipeline/options/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <set>

#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"
#include "synth/data_set.h"

namespace mimicx::pipeline::options {
namespace {

using test::kPi;

constexpr double kFps = 30.0;
constexpr double kGravity = 9.81;

/// A rigid body in the rest pose: root path and root rotation as functions of time, s.
motion::Reference rigid(int frames, const std::function<Vector3d(double)>& path,
                        const std::function<Quaterniond(double)>& turn) {
  motion::Reference r;
  r.name = "rigid";
  r.character = make_character();
  for (int t = 0; t < frames; ++t) {
    motion::ReferenceFrame f;
    f.p_root = path(t / kFps);
    f.q.fill(Quaterniond::Identity());
    f.q[0] = turn(t / kFps) * test::upright();
    r.frames.push_back(f);
    r.poses.push_back(forward_kinematics(r.character, f.p_root, f.q));
  }
  motion::differentiate(r.frames, kFps);
  return r;
}

Quaterniond still(double) { return Quaterniond::Identity(); }

/// A prepared random motion, moved and turned about the vertical as a whole.
motion::Reference moved_poses(const motion::Reference& reference, double angle, const Vector3d& offset) {
  motion::Reference out = reference;
  for (std::size_t t = 0; t < out.frames.size(); ++t) {
    auto& f = out.frames[t];
    f.q[0] = rotation_z(angle) * f.q[0];
    f.p_root = rotation_z(angle) * f.p_root + offset;
    out.poses[t] = forward_kinematics(out.character, f.p_root, f.q);
  }
  motion::differentiate(out.frames, out.fps);
  return out;
}

motion::Reference random_reference() {
  return motion::prepare_reference(test::random_clip(3, 90, 0.3), {}, nullptr);
}

TEST(Features, HaveUniqueNamesAndPositiveUnits) {
  EXPECT_EQ(kFeatures, 68);
  const auto& names = feature_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 68u);
  EXPECT_EQ(names[kAcceleration + kBodies - 1], "acceleration.right_wrist");
  for (double unit : feature_units()) EXPECT_GT(unit, 0.0);
}

TEST(Features, StandingStillHasOnlyHeight) {
  const auto f = motion_features(rigid(
      40, [](double) { return Vector3d(1, 2, 0.9); }, still));
  EXPECT_NEAR(f[kRootHeight], 0.9, 1e-12);
  for (std::size_t k = 1; k < kFeatures; ++k) EXPECT_NEAR(f[k], 0.0, 1e-18) << feature_names()[k];
}

TEST(Features, UniformTravelIsTheSquaredSpeedOfEveryJoint) {
  const Vector3d v(1.2, -0.5, 0.3);
  const auto f = motion_features(rigid(
      40, [&](double s) -> Vector3d { return Vector3d(0, 0, 0.9) + s * v; }, still));
  EXPECT_NEAR(f[kRootTurning], 0.0, 1e-18);
  for (std::size_t j = 0; j < kBodies; ++j) {
    EXPECT_NEAR(f[kPlanarVelocity + j], 1.2 * 1.2 + 0.5 * 0.5, 1e-10);
    EXPECT_NEAR(f[kVerticalVelocity + j], 0.3 * 0.3, 1e-10);
    EXPECT_NEAR(f[kAcceleration + j], 0.0, 1e-16);
  }
}

TEST(Features, FreeFallAcceleratesEveryJointWithGravityFromEndToEnd) {
  const int frames = 31;
  const auto f = motion_features(rigid(
      frames, [](double s) { return Vector3d(0, 0, 2.0 + 3.0 * s - 0.5 * kGravity * s * s); }, still));
  double vertical = 0.0;
  for (int t = 0; t < frames; ++t) vertical += std::pow(3.0 - kGravity * t / kFps, 2) / frames;
  for (std::size_t j = 0; j < kBodies; ++j) {
    EXPECT_NEAR(f[kAcceleration + j], kGravity * kGravity, 1e-8);
    EXPECT_NEAR(f[kVerticalVelocity + j], vertical, 1e-9);
    EXPECT_NEAR(f[kPlanarVelocity + j], 0.0, 1e-18);
  }
}

TEST(Features, TurningGivesTheSquaredRateAndCircularJointSpeeds) {
  const double rate = 1.1;
  const motion::Reference r = rigid(
      60, [](double) { return Vector3d(0, 0, 0.9); }, [&](double s) { return rotation_z(rate * s); });
  const auto f = motion_features(r);
  EXPECT_NEAR(f[kRootTurning], rate * rate, 1e-10);
  for (std::size_t j = 0; j < kBodies; ++j) {
    const double radius = r.poses[0].p_WB[j].head<2>().norm();
    // The parabola takes a percent off the curve of an arc of 17 degrees.
    EXPECT_NEAR(f[kPlanarVelocity + j], std::pow(rate * radius, 2),
                0.02 * std::pow(rate * radius, 2) + 1e-15);
    EXPECT_NEAR(f[kAcceleration + j], std::pow(rate * rate * radius, 2),
                0.02 * std::pow(rate * rate * radius, 2) + 1e-15);
    EXPECT_NEAR(f[kVerticalVelocity + j], 0.0, 1e-18);
  }
}

TEST(Features, SomersaultHasNoTurning) {
  const auto f = motion_features(rigid(
      60, [](double) { return Vector3d(0, 0, 1.5); },
      [](double s) {
        return exp_map({3.0 * s, 0.0, 0.0});
      }));
  EXPECT_NEAR(f[kRootTurning], 0.0, 1e-16);
  EXPECT_GT(f[kVerticalVelocity + kHead], 1.0);
}

TEST(Features, HeadingAndPlaceAreIrrelevant) {
  const motion::Reference reference = random_reference();
  const auto expected = motion_features(reference);
  for (double angle : {0.3, 1.7, -2.9}) {
    const auto f = motion_features(moved_poses(reference, angle, {5.0 * angle, -3.0, 0.0}));
    for (std::size_t k = 0; k < kFeatures; ++k)
      EXPECT_NEAR(f[k], expected[k], 1e-9 * (1.0 + expected[k])) << feature_names()[k];
  }
}

TEST(Features, LiftingChangesOnlyTheHeight) {
  const motion::Reference reference = random_reference();
  const auto before = motion_features(reference),
             after = motion_features(moved_poses(reference, 0, {0, 0, 0.25}));
  EXPECT_NEAR(after[kRootHeight], before[kRootHeight] + 0.25, 1e-12);
  for (std::size_t k = 1; k < kFeatures; ++k) EXPECT_NEAR(after[k], before[k], 1e-9 * (1.0 + before[k]));
}

TEST(Features, SmoothingSuppressesNoiseInTheAcceleration) {
  Random random(5, {0});
  const auto f = motion_features(rigid(
      600, [&](double) -> Vector3d { return Vector3d(0, 0, 0.9) + 0.005 * test::random_vector(random); },
      still));
  const double per_axis = std::sqrt(f[kAcceleration] / 3.0);
  EXPECT_NEAR(per_axis, 0.51,
              0.05);  // 0.005 · 900 · √(720/55440): variance of a 9-point parabola's curvature
}

TEST(Features, RejectTooShortMotions) {
  const auto path = [](double s) { return Vector3d(s, 0, 0.9); };
  EXPECT_THROW(motion_features(rigid(2, path, still)), DataError);
  EXPECT_NEAR(motion_features(rigid(3, path, still))[kPlanarVelocity], 1.0, 1e-10);
}

/// True motions of the basic kinds, the first seeds of the training split.
List<MotionFeatures> synthetic_features(int seeds) {
  synth::SynthSetConfig set;
  set.seed = synth::kTrainingSeed;
  set.clips = seeds * static_cast<int>(synth::basic_kinds().size());
  List<MotionFeatures> features;
  for (const synth::SynthConfig& clip : synth::clips_of_set(set))
    features.push_back(motion_features(motion::prepare_reference(synth::synthesize(clip), {}, nullptr)));
  return features;
}

// A kind of feature whose share is tiny decides nothing: R_avel once had 0.2 %.
TEST(Features, EveryKindHasACommensurateShareInTheVarianceOfSyntheticMotions) {
  const auto shares = kind_shares(synthetic_features(2));
  double sum = 0.0;
  for (int kind = 0; kind < kFeatureKindCount; ++kind) {
    const std::string_view name = kFeatureKinds[static_cast<std::size_t>(kind)].name;
    std::printf("  measured: %-17s %4.1f %%\n", std::string(name).c_str(), 100.0 * shares[kind]);
    EXPECT_GT(shares[kind], 0.08) << name;
    EXPECT_LT(shares[kind], 0.40) << name;
    sum += shares[kind];
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Features, KindSharesAreThoseOfTheVarianceInUnits) {
  List<MotionFeatures> motions(2, MotionFeatures{});
  motions[1][kRootTurning] = 3.0 * feature_units()[kRootTurning];
  motions[1][kAcceleration + kHead] = 1.0 * feature_units()[kAcceleration + kHead];
  const auto shares = kind_shares(motions);
  EXPECT_EQ(shares[0] + shares[2] + shares[3], 0.0);
  EXPECT_NEAR(shares[1], 0.9, 1e-12);
  EXPECT_NEAR(shares[4], 0.1, 1e-12);
  for (const double share : kind_shares({MotionFeatures{}})) EXPECT_EQ(share, 0.0);
}

TEST(Features, ScaledFeaturesAreInTheirUnits) {
  const auto scaled = scaled_features(feature_units());
  for (double x : scaled) EXPECT_DOUBLE_EQ(x, 1.0);
}

}  // namespace
}  // namespace mimicx::pipeline::options
