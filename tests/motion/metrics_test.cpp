#include "motion/metrics.h"
#include "motion/segment_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/decompositions.h"
#include "motion/published_protocols.h"
#include "motion/raised_clip.h"
#include "motion/standing_samples.h"
#include "motion/synthetic_clip.h"

namespace mimicx::motion {
namespace {

using test::kPi;

using test::samples_of;

/// The samples moved by offset(t) (m).
template <class Offset>
MotionSamples moved(MotionSamples s, const Offset& offset) {
  for (std::size_t t = 0; t < s.joints.size(); ++t) {
    const Vector3d d = offset(static_cast<double>(t));
    for (Vector3d& p : s.joints[t]) p += d;
    for (Vector3d& p : s.surface[t]) p += d;
  }
  return s;
}

TEST(Metrics, ConstantOffsetShowsInGlobalErrorsOnly) {
  const MotionSamples truth = samples_of(test::random_clip(1, 20, 0.4));
  const Metrics m =
      evaluate_motion(moved(truth, [](double) -> Vector3d { return Vector3d(0.03, -0.04, 0.12); }), &truth);
  EXPECT_NEAR(m.mrpe.value, 130.0, 1e-9);
  EXPECT_NEAR(m.gmpjpe.value, 130.0, 1e-9);
  for (const MetricValue& v : {m.mpjpe, m.pa_mpjpe, m.vel, m.accel}) EXPECT_NEAR(v.value, 0.0, 1e-9);
  EXPECT_EQ(m.mrpe.count, 20u);
  EXPECT_EQ(m.mpjpe.count, 20u * 22u);
  EXPECT_EQ(m.accel.count, 18u * 22u);
}

TEST(Metrics, VelIsALinearDriftAndAccelAQuadraticOne) {
  const MotionSamples truth = samples_of(test::random_clip(2, 21, 0.4));
  const Metrics linear = evaluate_motion(
      moved(truth, [](double t) -> Vector3d { return t * Vector3d(0.003, 0, 0.004); }), &truth);
  EXPECT_NEAR(linear.vel.value, 5.0, 1e-9);
  EXPECT_NEAR(linear.accel.value, 0.0, 1e-9);
  EXPECT_NEAR(linear.mrpe.value, 5.0 * 10.0, 1e-9);  // mean of 0 … 20 frames
  const Metrics square = evaluate_motion(
      moved(truth, [](double t) -> Vector3d { return 0.5 * t * t * Vector3d(0, 0.002, 0); }), &truth);
  EXPECT_NEAR(square.accel.value, 2.0, 1e-9);
}

TEST(Metrics, JitterIsTheThirdDerivativeOfACubic) {
  const MotionSamples still = test::standing_samples(12);
  const double fps = 30.0, third = 7.0;  // m/s³
  const Metrics m = evaluate_motion(
      moved(still,
            [&](double t) -> Vector3d { return third / 6.0 * std::pow(t / fps, 3) * Vector3d::UnitX(); }),
      nullptr);
  EXPECT_NEAR(m.jitter.value, third / 10.0, 1e-9);
}

TEST(Metrics, ScalingAPoseChangesMpjpeButNotPaMpjpe) {
  const MotionSamples truth = samples_of(test::random_clip(3, 10, 0.4));
  MotionSamples scaled = truth;
  double mean = 0.0;
  for (auto& joints : scaled.joints) {
    const Vector3d root = joints[0];
    for (Vector3d& p : joints) {
      mean += (p - root).norm() / (10.0 * kBodies);
      p = root + 1.1 * (p - root);
    }
  }
  const Metrics m = evaluate_motion(scaled, &truth);
  EXPECT_NEAR(m.mpjpe.value, 0.1 * mean * 1000.0, 1e-9);
  EXPECT_NEAR(m.pa_mpjpe.value, 0.0, 1e-6);
  EXPECT_NEAR(m.mrpe.value, 0.0, 1e-9);
}

TEST(Metrics, TurnAboutTheRootMovesEachJointByItsChord) {
  const MotionSamples truth = samples_of(test::random_clip(4, 10, 0.4));
  MotionSamples turned = truth;
  const double angle = 0.3;
  double mean = 0.0;
  for (auto& joints : turned.joints) {
    const Vector3d root = joints[0];
    for (Vector3d& p : joints) {
      mean += 2.0 * std::sin(angle / 2) * (p - root).head<2>().norm() / (10.0 * kBodies);
      p = root + rotation_z(angle) * (p - root);
    }
  }
  const Metrics m = evaluate_motion(turned, &truth);
  EXPECT_NEAR(m.mpjpe.value, mean * 1000.0, 1e-9);
  EXPECT_NEAR(m.pa_mpjpe.value, 0.0, 1e-6);
}

TEST(Metrics, ProcrustesAlignmentExcludesReflections) {
  const MotionSamples truth = samples_of(test::random_clip(5, 5, 0.6));
  MotionSamples mirrored = truth;
  for (auto& joints : mirrored.joints)
    for (Vector3d& p : joints) p.x() = -p.x();
  EXPECT_GT(evaluate_motion(mirrored, &truth).pa_mpjpe.value, 20.0);
}

TEST(FootSlide, EqualsTheSpeedOfAUniformSlideWithinTheTolerance) {
  const auto slide = [](double height) {
    return evaluate_motion(
        moved(test::standing_samples(11),
              [&](double t) -> Vector3d { return Vector3d(0.006 * t, 0.008 * t, height); }),
        nullptr);
  };
  EXPECT_NEAR(slide(-1e-6).fs.value, 10.0, 1e-9);
  EXPECT_NEAR(slide(-1e-6).fs_0.value, 10.0, 1e-9);
  EXPECT_NEAR(slide(0.004).fs.value, 10.0, 1e-9);
  EXPECT_EQ(slide(0.004).fs_0.value, 0.0);
  EXPECT_EQ(slide(0.006).fs.value, 0.0);
  EXPECT_EQ(slide(0.006).fs.count, 10u);  // pairs without contact count as 0
}

TEST(FootSlide, CountsOnlyPointsDownInBothFrames) {
  // Down in the first half, sliding and lifted in the second: 4 of 9 pairs slide on the floor.
  const Metrics m =
      evaluate_motion(moved(test::standing_samples(10),
                            [](double t) -> Vector3d { return Vector3d(0.009 * t, 0, t < 5 ? 0.0 : 0.1); }),
                      nullptr);
  EXPECT_NEAR(m.fs.value, 9.0 * 4.0 / 9.0, 1e-9);
}

TEST(Penetration, IsTheDepthOfTheSunkPoints) {
  const Metrics m = evaluate_motion(
      moved(test::standing_samples(4), [](double) -> Vector3d { return Vector3d(0, 0, -0.003); }), nullptr);
  EXPECT_NEAR(m.gp.value, 3.0, 1e-9);  // the twelve points of the soles, all equally deep
  EXPECT_NEAR(m.gp_max.value, 3.0, 1e-9);
  EXPECT_EQ(evaluate_motion(test::standing_samples(4), nullptr).gp_max.count, 4u);
  EXPECT_NEAR(evaluate_motion(test::standing_samples(4), nullptr).gp.value, 0.0, 1e-9);
  EXPECT_NEAR(evaluate_motion(test::standing_samples(4), nullptr).floating.value, 0.0, 1e-9);
}

TEST(Penetration, AveragesTheSunkPointsAndMaxTakesTheDeepest) {
  MotionSamples s = test::standing_samples(2);
  for (Vector3d& p : s.surface[0]) p.z() = 1.0;
  s.surface[0][3].z() = -0.010;
  s.surface[0][40].z() = -0.002;
  const Metrics m = evaluate_motion(s, nullptr);
  EXPECT_NEAR(m.gp.value, (10.0 + 2.0) / 2.0 / 2.0, 1e-9);
  EXPECT_NEAR(m.gp_max.value, 10.0 / 2.0, 1e-9);
}

TEST(Float, IsTheHeightOfAStaticLiftAboveTheTolerance) {
  const auto lifted = [](double z) {
    return evaluate_motion(
               moved(test::standing_samples(4), [&](double) -> Vector3d { return Vector3d(0, 0, z); }),
               nullptr)
        .floating.value;
  };
  EXPECT_EQ(lifted(0.004), 0.0);
  EXPECT_NEAR(lifted(0.0726), 72.6, 1e-9);
}

TEST(Float, OnlyFloatGtIgnoresJumpsOfTheTruth) {
  const MotionSamples truth = moved(test::standing_samples(10),
                                    [](double t) -> Vector3d { return Vector3d(0, 0, t < 4 ? 0.0 : 0.3); });
  const Metrics same = evaluate_motion(truth, &truth);
  EXPECT_NEAR(same.floating.value, 300.0 * 0.6, 1e-9);
  EXPECT_NEAR(same.float_gt.value, 0.0, 1e-9);
  EXPECT_EQ(same.float_gt.count, 4u);
  const Metrics lifted =
      evaluate_motion(moved(truth, [](double) -> Vector3d { return Vector3d(0, 0, 0.02); }), &truth);
  EXPECT_NEAR(lifted.float_gt.value, 20.0, 1e-9);
}

TEST(FootSlideGt, CountsOnlyPointsThatStandInTheTruth) {
  const MotionSamples truth = test::standing_samples(10);
  const auto slid = [&](double speed) {
    return moved(truth, [&](double t) -> Vector3d { return Vector3d(0, speed * t, 0.5); });
  };
  const MotionSamples evaluated = slid(0.003);
  EXPECT_NEAR(evaluate_motion(evaluated, &truth).fs_gt.value, 3.0, 1e-9);  // in the air as well
  EXPECT_EQ(evaluate_motion(evaluated, &truth).fs_gt.count, 9u * kFootPoints);
  const MotionSamples walking = slid(0.011);
  EXPECT_TRUE(std::isnan(evaluate_motion(evaluated, &walking).fs_gt.value));
}

TEST(SelfPenetration, IsTheOverlapOfTheCapsules) {
  Character c = make_character();
  c.self_pairs = {{kLeftWrist, kRightWrist}, {kLeftWrist, kHead}};
  BodyPoses pose = poses_of(test::standing_clip(1, 1.0))[0];
  // Crossed sticks 50 mm apart, radii 30 and 40 mm: 20 mm deep. The head stays out of reach.
  c.capsule[kLeftWrist] = {kLeftWrist, {-0.2, 0, 0}, {0.2, 0, 0}, 0.03};
  c.capsule[kRightWrist] = {kRightWrist, {0, 0, -0.2}, {0, 0, 0.2}, 0.04};
  for (const int wrist : {kLeftWrist, kRightWrist}) pose.q_WB[wrist] = Quaterniond::Identity();
  pose.p_WB[kLeftWrist] = {5, 5, 5};
  pose.p_WB[kRightWrist] = {5, 5.05, 5};
  BodyPoses apart = pose;
  apart.p_WB[kRightWrist].y() += 1.0;
  const Metrics m = evaluate_motion(sample_motion(c, {pose, apart}, 30.0), nullptr);
  EXPECT_NEAR(m.self_pen.value, 20.0 / 2.0, 1e-9);
  c.capsule[kHead] = {kHead, {0, 0, 0}, {0, 0.1, 0}, 10.0};  // now both pairs overlap: their mean
  const double head_depth =
      1000.0 * evaluate_motion(sample_motion(c, {apart}, 30.0), nullptr).self_pen.value / 1000.0;
  EXPECT_NEAR(evaluate_motion(sample_motion(c, {pose}, 30.0), nullptr).self_pen.value,
              (20.0 + head_depth) / 2.0, 1e-9);
}

TEST(SegmentDistance, EqualsBruteForceOverBothSegments) {
  Random random(9, {1});
  for (int n = 0; n < 300; ++n) {
    const Vector3d a0 = test::random_vector(random), b0 = test::random_vector(random);
    Vector3d a1 = test::random_vector(random), b1 = test::random_vector(random);
    if (n % 3 == 0) b1 = b0 + 0.7 * (a1 - a0);  // parallel
    if (n % 5 == 0) a1 = a0;                    // a point
    if (n % 7 == 0) b1 = b0;
    // The distance to a fixed point of one segment is closed form; the other parameter by a fine grid.
    double best = 1e9;
    for (int i = 0; i <= 20000; ++i) {
      const Vector3d p = a0 + i / 20000.0 * (a1 - a0), d = b1 - b0;
      const double t = d.squaredNorm() > 0 ? std::clamp((p - b0).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
      best = std::min(best, (b0 + t * d - p).norm());
    }
    const double distance = segment_distance(a0, a1, b0, b1);
    EXPECT_LE(distance, best + 1e-9);
    EXPECT_NEAR(distance, best, 1e-3);
  }
}

/// Rotation by Horn's quaternion method (J. Opt. Soc. Am. A 4, 1987): the largest eigenvector of a 4×4
/// matrix.
double horn_error(const PerBody<Vector3d>& p, const PerBody<Vector3d>& g) {
  Vector3d cp = Vector3d::Zero(), cg = Vector3d::Zero();
  for (std::size_t j = 0; j < kBodies; ++j) cp += p[j] / kBodies, cg += g[j] / kBodies;
  Matrix3d S = Matrix3d::Zero();
  double size = 0.0;
  for (std::size_t j = 0; j < kBodies; ++j)
    S += (p[j] - cp) * (g[j] - cg).transpose(), size += (p[j] - cp).squaredNorm();
  Eigen::Matrix4d N;
  N << S.trace(), S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0), 0, S(0, 0) - S(1, 1) - S(2, 2),
      S(0, 1) + S(1, 0), S(2, 0) + S(0, 2), 0, 0, -S(0, 0) + S(1, 1) - S(2, 2), S(1, 2) + S(2, 1), 0, 0, 0,
      -S(0, 0) - S(1, 1) + S(2, 2);
  const Eigen::Vector4d v = symmetric_eigen(N.transpose()).vectors.col(3);
  const Quaterniond q(v[0], v[1], v[2], v[3]);
  double dot = 0.0, error = 0.0;
  for (std::size_t j = 0; j < kBodies; ++j) dot += (q * (p[j] - cp)).dot(g[j] - cg);
  for (std::size_t j = 0; j < kBodies; ++j)
    error += (dot / size * (q * (p[j] - cp)) - (g[j] - cg)).norm() / kBodies;
  return error;
}

TEST(Metrics, AgreeWithAnIndependentImplementationOnRandomMotions) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MotionSamples g = samples_of(test::random_clip(seed, 25, 0.3)),
                        p = samples_of(test::random_clip(seed + 50, 25, 0.3));
    const Metrics m = evaluate_motion(p, &g);
    double root = 0, global = 0, local = 0, procrustes = 0, vel = 0, accel = 0, jitter = 0;
    double slide = 0, depth = 0, deepest = 0, height = 0, static_slide = 0;
    int static_points = 0;
    for (std::size_t t = 0; t < 25; ++t) {
      root += (p.joints[t][0] - g.joints[t][0]).norm() / 25;
      procrustes += horn_error(p.joints[t], g.joints[t]) / 25;
      for (std::size_t j = 0; j < kBodies; ++j) {
        std::array<Vector3d, 25> e, q;  // error and position of one joint over time
        for (std::size_t s = 0; s < 25; ++s) e[s] = p.joints[s][j] - g.joints[s][j], q[s] = p.joints[s][j];
        global += e[t].norm() / (25 * kBodies);
        local += (e[t] - (p.joints[t][0] - g.joints[t][0])).norm() / (25 * kBodies);
        if (t >= 1) vel += (e[t] - e[t - 1]).norm() / (24 * kBodies);
        if (t >= 2) accel += ((e[t] - e[t - 1]) - (e[t - 1] - e[t - 2])).norm() / (23 * kBodies);
        if (t >= 3) jitter += (q[t] - 3 * q[t - 1] + 3 * q[t - 2] - q[t - 3]).norm() / (22 * kBodies);
      }
      double sum = 0, lowest = 1e9, moved_sum = 0;
      int below = 0, on_floor = 0;
      for (std::size_t i = 0; i < p.surface[t].size(); ++i) {
        const Vector3d& x = p.surface[t][i];
        lowest = std::min(lowest, x.z());
        if (x.z() < 0) sum -= x.z(), ++below;
        if (t == 0) continue;
        const Vector3d& before = p.surface[t - 1][i];
        if (x.z() <= 0.005 && before.z() <= 0.005)
          moved_sum += std::hypot(x.x() - before.x(), x.y() - before.y()), ++on_floor;
        if (i < 12 && (g.surface[t][i] - g.surface[t - 1][i]).norm() < 0.01)
          static_slide += (x - before).norm(), ++static_points;
      }
      if (below) depth += sum / below / 25;
      if (on_floor) slide += moved_sum / on_floor / 24;
      deepest += lowest < 0 ? -lowest / 25 : 0;
      height += lowest > 0.005 ? lowest / 25 : 0;
    }
    EXPECT_NEAR(m.mrpe.value, 1000 * root, 1e-6);
    EXPECT_NEAR(m.gmpjpe.value, 1000 * global, 1e-6);
    EXPECT_NEAR(m.mpjpe.value, 1000 * local, 1e-6);
    EXPECT_NEAR(m.pa_mpjpe.value, 1000 * procrustes, 1e-6);
    EXPECT_NEAR(m.vel.value, 1000 * vel, 1e-6);
    EXPECT_NEAR(m.accel.value, 1000 * accel, 1e-6);
    EXPECT_NEAR(m.jitter.value, jitter * 30 * 30 * 30 / 10, 1e-6);
    EXPECT_NEAR(m.fs.value, 1000 * slide, 1e-6);
    EXPECT_NEAR(m.gp.value, 1000 * depth, 1e-6);
    EXPECT_NEAR(m.gp_max.value, 1000 * deepest, 1e-6);
    EXPECT_NEAR(m.floating.value, 1000 * height, 1e-6);
    if (static_points) {
      EXPECT_NEAR(m.fs_gt.value, 1000 * static_slide / static_points, 1e-6);
    }
    EXPECT_GT(depth, 0.0) << "the random motion must exercise the floor";
  }
}

TEST(Metrics, AreUndefinedWithoutTruthOrEnoughFrames) {
  const Metrics alone = evaluate_motion(test::standing_samples(3), nullptr);
  for (const MetricValue& v :
       {alone.mrpe, alone.mpjpe, alone.pa_mpjpe, alone.vel, alone.fs_gt, alone.float_gt, alone.jitter}) {
    EXPECT_TRUE(std::isnan(v.value));
    EXPECT_EQ(v.count, 0u);
  }
  EXPECT_FALSE(std::isnan(alone.fs.value));
  const MotionSamples one = test::standing_samples(1);
  const Metrics single = evaluate_motion(one, &one);
  EXPECT_TRUE(std::isnan(single.fs.value));
  EXPECT_TRUE(std::isnan(single.vel.value));
  EXPECT_EQ(single.mpjpe.value, 0.0);
}

TEST(Metrics, RejectsMotionsOfDifferentLengthOrRate) {
  const MotionSamples truth = test::standing_samples(5);
  EXPECT_THROW(evaluate_motion(test::standing_samples(4), &truth), std::invalid_argument);
  MotionSamples faster = truth;
  faster.fps = 60.0;
  EXPECT_THROW(evaluate_motion(faster, &truth), std::invalid_argument);
  MotionSamples bare = truth;
  bare.surface.pop_back();
  EXPECT_THROW(evaluate_motion(bare, nullptr), std::invalid_argument);
}

TEST(Metrics, EveryValueHasOneDefinition) {
  Metrics m;
  std::set<const MetricValue*> values;
  std::set<std::string> names;
  for (const MetricDefinition& d : metric_definitions()) {
    values.insert(&(m.*d.value));
    names.insert(d.name);
  }
  EXPECT_EQ(values.size() * sizeof(MetricValue), sizeof(Metrics));
  EXPECT_EQ(names.size(), values.size());
}

TEST(Success, RequiresFullLengthSmallDistanceAndSmallMpjpe) {
  const MotionSamples reference = samples_of(test::random_clip(7, 20, 0.3));
  EXPECT_TRUE(success_of(reference, reference).success);
  EXPECT_TRUE(success_of(moved(reference, [](double) -> Vector3d { return Vector3d(0.49, 0, 0); }), reference)
                  .success);
  const Success far = success_of(
      moved(reference, [](double t) -> Vector3d { return Vector3d(t == 7 ? 0.51 : 0.0, 0, 0); }), reference);
  EXPECT_FALSE(far.success);
  EXPECT_NEAR(far.max_distance_m, 0.51, 1e-9);
  EXPECT_NE(far.reason.find("0.5 m"), std::string::npos);

  // All joints but the root off by d: MPJPE is d·21/22.
  const auto bent = [&](double d) {
    MotionSamples s = reference;
    for (auto& joints : s.joints)
      for (std::size_t j = 1; j < kBodies; ++j) joints[j].x() += d * kBodies / (kBodies - 1.0);
    return success_of(s, reference);
  };
  EXPECT_TRUE(bent(0.0599).success);
  EXPECT_FALSE(bent(0.0601).success);
  EXPECT_NEAR(bent(0.0601).mpjpe_mm, 60.1, 1e-6);

  MotionSamples fallen = reference;
  fallen.joints.resize(19);
  fallen.surface.resize(19);
  EXPECT_FALSE(success_of(fallen, reference).success);
  MotionSamples broken = reference;
  broken.joints[3][5].x() = std::nan("");
  EXPECT_FALSE(success_of(broken, reference).success);
}

TEST(Metrics, OnAPlateAreAsOnTheFloor) {
  const Clip clip = test::synthetic_clip("walk", 4, 60), high = test::raised(clip);
  const auto samples = [](const Clip& c, double sunk) {
    Clip moved = c;
    for (int t = 0; t < c.frames(); ++t) moved.trans[t] += Vector3d(0.003 * t, 0.0, sunk * std::sin(0.3 * t));
    return sample_motion(character_of(moved), poses_of(moved), moved.fps, moved.scene);
  };
  const MotionSamples truth = samples(clip, 0.0), high_truth = samples(high, 0.0);
  const Metrics low_m = evaluate_motion(samples(clip, 0.03), &truth),
                high_m = evaluate_motion(samples(high, 0.03), &high_truth);
  EXPECT_GT(low_m.gp.value, 0.1);
  EXPECT_GT(low_m.floating.value, 0.1);
  EXPECT_GT(low_m.fs.value, 0.1);
  for (const MetricDefinition& d : metric_definitions()) {
    const double a = (low_m.*d.value).value, b = (high_m.*d.value).value;
    EXPECT_TRUE(std::isnan(a) ? std::isnan(b) : std::abs(a - b) < 1e-6) << d.name << ": " << a << ", " << b;
  }
  for (const Protocol protocol : {Protocol::kPhc, Protocol::kPmr}) {
    const auto a = evaluate_by(protocol, samples(clip, 0.03), truth),
               b = evaluate_by(protocol, samples(high, 0.03), high_truth);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k].value, b[k].value, 1e-6) << k;
  }
}

}  // namespace
}  // namespace mimicx::motion
