#include "motion/published_protocols.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motion/procrustes.h"
#include "motion/standing_samples.h"

namespace mimicx::motion {
namespace {

using test::samples_of;

/// The samples with every point p of frame t at f(t, p).
template <class Map>
MotionSamples mapped(MotionSamples s, const Map& f) {
  for (int t = 0; t < s.frames(); ++t) {
    for (Vector3d& p : s.joints[t]) p = f(t, p);
    for (Vector3d& p : s.surface[t]) p = f(t, p);
  }
  return s;
}
MotionSamples moved_samples(const MotionSamples& s, const Vector3d& by) {
  return mapped(s, [&](int, const Vector3d& p) -> Vector3d { return p + by; });
}

MetricValue metric_of(Protocol protocol, const char* name, const MotionSamples& p, const MotionSamples& g) {
  const auto& columns = protocol_columns(protocol);
  const auto values = evaluate_by(protocol, p, g);
  EXPECT_EQ(values.size(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (std::string(columns[k].name) == name) return values[k];
  throw std::invalid_argument(name);
}

double phc(const char* name, const MotionSamples& p, const MotionSamples& g) {
  return metric_of(Protocol::kPhc, name, p, g).value;
}
double pmr(const char* name, const MotionSamples& p, const MotionSamples& g) {
  return metric_of(Protocol::kPmr, name, p, g).value;
}
double emdb(const char* name, const MotionSamples& p, const MotionSamples& g) {
  return metric_of(Protocol::kEmdb, name, p, g).value;
}

/// A random motion whose pelvis walks `way` metres along x in `frames` frames.
MotionSamples walking(int frames, double way) {
  return mapped(samples_of(test::random_clip(7, frames, 0.4)), [&](int t, const Vector3d& p) -> Vector3d {
    return p + way * t / (frames - 1) * Vector3d::UnitX();
  });
}

TEST(Protocol, TranslationChangesGlobalErrorsOnly) {
  const MotionSamples truth = walking(150, 6.0), p = moved_samples(truth, {0.3, -0.4, 0.0});
  EXPECT_NEAR(phc("E_g-mpjpe", p, truth), 500.0, 1e-9);
  for (const char* name : {"E_mpjpe", "E_pa-mpjpe", "E_acc", "E_vel"})
    EXPECT_NEAR(phc(name, p, truth), 0.0, 1e-9) << name;
  for (const char* name : {"WA-MPJPE", "W-MPJPE", "RTE"})
    EXPECT_NEAR(emdb(name, p, truth), 0.0, 1e-6) << name;
}

TEST(Protocol, WorldErrorsIgnoreHeadingAndScale) {
  const MotionSamples truth = walking(230, 6.0);
  const Quaterniond turn = rotation_z(0.7);
  const MotionSamples turned = mapped(truth, [&](int, const Vector3d& p) -> Vector3d { return turn * p; });
  for (const char* name : {"WA-MPJPE", "W-MPJPE", "RTE"})
    EXPECT_NEAR(emdb(name, turned, truth), 0.0, 1e-6) << name;
  const MotionSamples scaled = mapped(truth, [&](int, const Vector3d& p) -> Vector3d { return 1.1 * p; });
  for (const char* name : {"WA-MPJPE", "W-MPJPE"}) EXPECT_NEAR(emdb(name, scaled, truth), 0.0, 1e-6) << name;
  EXPECT_GT(emdb("RTE", scaled, truth), 1.0);  // the root's way keeps its scale
}

/// A straight way of n equal steps that is scaled by s: after the rigid fit the pelvis is off by
/// |s − 1| · |x − mean|, whose mean over the frames is a quarter of the way (for many frames).
TEST(Protocol, RootErrorOfAScaledStraightPathIsAQuarterOfTheScaleError) {
  const int n = 401;
  MotionSamples truth = test::standing_samples(n);
  truth =
      mapped(truth, [](int t, const Vector3d& p) -> Vector3d { return p + 0.02 * t * Vector3d::UnitX(); });
  const MotionSamples p =
      mapped(truth, [](int t, const Vector3d& q) -> Vector3d { return q + 0.002 * t * Vector3d::UnitX(); });
  double mean = 0.0;
  for (int t = 0; t < n; ++t) mean += 0.002 * std::abs(t - 0.5 * (n - 1)) / n;
  EXPECT_NEAR(emdb("RTE", p, truth), 100.0 * mean / (0.02 * (n - 1)), 1e-9);
  EXPECT_NEAR(emdb("RTE", p, truth), 2.5, 0.01);
}

TEST(Protocol, RootErrorIsUndefinedForAMotionInPlace) {
  const MotionSamples truth = test::standing_samples(20);
  const MetricValue rte = metric_of(Protocol::kEmdb, "RTE", moved_samples(truth, {0.1, 0.0, 0.0}), truth);
  EXPECT_EQ(rte.count, 0u);
  EXPECT_TRUE(std::isnan(rte.value));
}

/// The first two frames of each segment are exact, later ones are off by d: W-MPJPE is the mean of that. A
/// second segment of a single frame is fitted alone.
TEST(Protocol, WMpjpeAlignsTheFirstTwoOfHundredFrames) {
  const MotionSamples truth = walking(101, 3.0);
  const MotionSamples p = mapped(truth, [](int t, const Vector3d& q) -> Vector3d {
    return q + (t >= 2 ? 0.05 : 0.0) * Vector3d::UnitY();
  });
  EXPECT_NEAR(emdb("W-MPJPE", p, truth), 50.0 * 98.0 / 101.0, 1e-6);
  EXPECT_LT(emdb("WA-MPJPE", p, truth), 3.0);
}

TEST(Protocol, DriftRaisesWMpjpeMoreThanWaMpjpe) {
  const MotionSamples truth = walking(100, 3.0);
  const MotionSamples p =
      mapped(truth, [](int t, const Vector3d& q) -> Vector3d { return q + 0.002 * t * Vector3d::UnitY(); });
  EXPECT_GT(emdb("W-MPJPE", p, truth), 60.0);
  EXPECT_LT(emdb("WA-MPJPE", p, truth), 0.5 * emdb("W-MPJPE", p, truth));
}

TEST(Protocol, SuccessEndsWhereTheMeanDistanceExceedsHalfAMetre) {
  const MotionSamples truth = walking(30, 1.0);
  const auto off = [&](double metres) {
    return mapped(truth, [&](int t, const Vector3d& p) -> Vector3d {
      return p + (t == 17 ? metres : 0.0) * Vector3d::UnitZ();
    });
  };
  EXPECT_EQ(phc("Succ", off(0.499), truth), 100.0);
  EXPECT_EQ(phc("Succ", off(0.501), truth), 0.0);
}

/// The mean is over the pelvis and 19 joints: toes do not count, nor do the initial frame and the
/// first simulated one.
TEST(Protocol, SuccessExcludesToesAndTheFirstTwoFrames) {
  const MotionSamples truth = walking(30, 1.0);
  const auto with = [&](int t, int body, double metres) {
    MotionSamples p = truth;
    p.joints[t][body].z() += metres;
    return phc("Succ", p, truth);
  };
  EXPECT_EQ(with(3, kLeftWrist, 9.99), 100.0);  // 0.4995 m in the mean of 20
  EXPECT_EQ(with(3, kLeftWrist, 10.01), 0.0);
  EXPECT_EQ(with(3, kLeftFoot, 100.0), 100.0);
  EXPECT_EQ(with(3, kRightFoot, 100.0), 100.0);
  EXPECT_EQ(with(2, kPelvis, 10.01), 0.0);
  EXPECT_EQ(with(1, kPelvis, 10.01), 100.0);
}

TEST(Protocol, DepthAndFloatCountHeightsBeyondFiveMillimetres) {
  const MotionSamples truth = test::standing_samples(10);
  double lowest = HUGE_VAL;
  for (const Vector3d& p : truth.surface[0]) lowest = std::min(lowest, p.z());
  const MotionSamples floor = moved_samples(truth, {0.0, 0.0, -lowest});
  for (const double z : {0.004, -0.004}) {
    EXPECT_EQ(pmr("GP", moved_samples(floor, {0.0, 0.0, z}), truth), 0.0);
    EXPECT_EQ(pmr("Float", moved_samples(floor, {0.0, 0.0, z}), truth), 0.0);
  }
  EXPECT_NEAR(pmr("GP", moved_samples(floor, {0.0, 0.0, -0.02}), truth), 20.0, 1e-9);
  EXPECT_EQ(pmr("Float", moved_samples(floor, {0.0, 0.0, -0.02}), truth), 0.0);
  EXPECT_NEAR(pmr("Float", moved_samples(floor, {0.0, 0.0, 0.03}), truth), 30.0, 1e-9);
}

TEST(Protocol, EveryFootSlideEqualsTheSpeedOfAUniformSlide) {
  const MotionSamples truth = test::standing_samples(12);
  const MotionSamples p =
      mapped(truth, [](int t, const Vector3d& q) -> Vector3d { return q + 0.007 * t * Vector3d::UnitY(); });
  EXPECT_NEAR(pmr("FS", p, truth), 7.0, 1e-9);
  EXPECT_NEAR(emdb("FS", p, truth), 7.0, 1e-9);
  const MotionSamples lifted = moved_samples(p, {0.0, 0.0, 0.1});
  EXPECT_EQ(pmr("FS", lifted, truth), 0.0);           // nothing touches
  EXPECT_NEAR(emdb("FS", lifted, truth), 7.0, 1e-9);  // the truth stands
}

TEST(Protocol, PoolingWeightsBySampleCount) {
  const MetricValue all = pooled({{10.0, 1}, {40.0, 2}, {}});
  EXPECT_NEAR(all.value, 30.0, 1e-12);
  EXPECT_EQ(all.count, 3u);
  EXPECT_TRUE(std::isnan(pooled({{}, {}}).value));
}

TEST(Protocol, RejectsMotionsItIsNotDefinedFor) {
  const MotionSamples truth = test::standing_samples(10);
  MotionSamples fast = truth;
  fast.fps = 120.0;
  for (const Protocol protocol : {Protocol::kPhc, Protocol::kPmr, Protocol::kEmdb}) {
    EXPECT_THROW(evaluate_by(protocol, test::standing_samples(9), truth), std::invalid_argument);
    EXPECT_THROW(evaluate_by(protocol, fast, fast), std::invalid_argument);
    EXPECT_THROW(evaluate_by(protocol, test::standing_samples(1), test::standing_samples(1)),
                 std::invalid_argument);
  }
}

TEST(Similarity, RecoversTheTransformThatMadeThePoints) {
  const Points p = Points::Random(3, 9);
  Similarity made;
  made.scale = 1.7;
  made.R = exp_map(Vector3d(0.4, -1.1, 0.6)).toRotationMatrix();
  made.offset = Vector3d(3.0, -2.0, 0.5);
  const Similarity found = nearest_similarity(p, made.of(p));
  EXPECT_NEAR(found.scale, made.scale, 1e-12);
  EXPECT_LT((found.R - made.R).norm(), 1e-12);
  EXPECT_LT((found.offset - made.offset).norm(), 1e-12);
  EXPECT_EQ(nearest_similarity(p, made.of(p), true).scale, 1.0);
  Points mirrored = p;
  mirrored.row(0) *= -1.0;
  EXPECT_NEAR(nearest_similarity(p, mirrored).R.determinant(), 1.0, 1e-12);  // no reflection
}

}  // namespace
}  // namespace mimicx::motion
