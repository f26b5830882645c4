#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "synth/inverse_kinematics.h"
#include "synth/min_jerk_track.h"

namespace mimicx::synth {
namespace {

std::array<double, kBetas> random_betas(Random& random) {
  std::array<double, kBetas> betas;
  for (double& beta : betas) beta = random.uniform(-2.0, 2.0);
  return betas;
}

/// The joint rotations of a solved leg; everything else at rest.
PerBody<Quaterniond> with_leg(int side, const Quaterniond& q_pelvis, const LegPose& leg,
                              const FootPose& foot) {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = q_pelvis;
  q[kLeftHip + side] = leg.hip;
  q[kLeftKnee + side] = exp_map(leg.knee * hinge_axis(kLeftKnee + side));
  q[kLeftAnkle + side] = leg.ankle;
  q[kLeftFoot + side] = foot.q_toes;
  return q;
}

TEST(SolveLeg, PutsTheFootOnItsTarget) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const Character c = make_character(random_betas(random));
    const int side = trial % 2;
    const double reach = c.joint_offset[kLeftKnee].norm() + c.joint_offset[kLeftAnkle].norm();
    const Quaterniond q_pelvis = rotation_z(random.uniform(-3.0, 3.0)) * kModelToPlan *
                                 exp_map(0.3 * Vector3d(random.normal(), random.normal(), random.normal()));
    FootTarget target;
    target.place = {random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.25)};
    target.yaw = random.uniform(-1.0, 1.0);
    target.lift = random.uniform(0.0, 0.1);
    target.heel_rise = random.uniform(0.0, 0.6);
    const FootPose foot = foot_pose(c, side, target);
    const Vector3d p_pelvis(0.0, 0.0, random.uniform(0.6, 0.85) * reach + 0.2);
    const LegPose leg =
        solve_leg(c, side, p_pelvis, q_pelvis, foot, rotation_z(target.yaw) * Vector3d::UnitY());
    ASSERT_LT(leg.shortfall, 1e-9);
    EXPECT_GT(leg.knee, 0.0);
    const BodyPoses poses = forward_kinematics(c, p_pelvis, with_leg(side, q_pelvis, leg, foot));
    EXPECT_LT((poses.p_WB[kLeftAnkle + side] - foot.p_ankle).norm(), 1e-9);
    EXPECT_LT(log_map(poses.q_WB[kLeftAnkle + side].conjugate() * foot.q_ankle).norm(), 1e-9);
  }
}

TEST(SolveLeg, PointsTheKneeAxisAsRequested) {
  const Character c = make_character();
  const Quaterniond q_pelvis = kModelToPlan;
  for (double yaw : {-0.4, 0.0, 0.5}) {
    FootTarget target;
    target.place = {0.1, 0.1};
    const FootPose foot = foot_pose(c, 0, target);
    const Vector3d axis = rotation_z(yaw) * Vector3d::UnitY(), p_pelvis(0.0, 0.0, 0.75);
    const LegPose leg = solve_leg(c, 0, p_pelvis, q_pelvis, foot, axis);
    const Vector3d knee_axis = q_pelvis * leg.hip * Vector3d::UnitX();
    const Vector3d along = (foot.p_ankle - p_pelvis - q_pelvis * c.joint_offset[kLeftHip]).normalized();
    // Seen along the leg, the knee's axis has the requested direction.
    EXPECT_LT(std::abs(along.cross(axis).normalized().dot(knee_axis)), 1e-12);
    EXPECT_GT(knee_axis.dot(axis), 0.9);
  }
}

TEST(SolveLeg, ReportsHowFarATargetIsOutOfReach) {
  const Character c = make_character();
  const FootPose foot = foot_pose(c, 1, {});
  const auto shortfall = [&](double height) {
    return solve_leg(c, 1, {0.0, 0.0, height}, kModelToPlan, foot, Vector3d::UnitY()).shortfall;
  };
  EXPECT_LT(shortfall(0.9), 1e-12);
  EXPECT_NEAR(shortfall(1.5) - shortfall(1.4), 0.1, 1e-3);
}

/// Points of a sole, in the order of Character::contact_points.
std::array<Vector3d, 6> sole(const Character& c, int side, const FootTarget& target) {
  const FootPose foot = foot_pose(c, side, target);
  const Vector3d p_toes = foot.p_ankle + foot.q_ankle * c.joint_offset[kLeftFoot + side];
  const Quaterniond q_toes = foot.q_ankle * foot.q_toes;
  std::array<Vector3d, 6> points;
  for (std::size_t i = 0; i < 6; ++i) {
    const ContactPoint& point = c.contact_points[side == 0 ? i : 6 + i];
    points[i] = point.body == kLeftFoot + side ? Vector3d(p_toes + q_toes * sole_point(point))
                                               : Vector3d(foot.p_ankle + foot.q_ankle * sole_point(point));
  }
  return points;
}

TEST(FootPose, RollsOverItsToesAndOverItsHeelWithoutMovingThem) {
  Random random(2);
  for (int side : {0, 1}) {
    const Character c = make_character(random_betas(random));
    FootTarget target;
    target.place = {0.3, -0.2};
    target.yaw = 0.4;
    const auto flat = sole(c, side, target);
    for (const Vector3d& point : flat) EXPECT_NEAR(point.z(), 0.0, 1e-12);
    for (double pitch : {0.1, 0.4, 0.8}) {
      target.heel_rise = pitch;
      const auto on_toes = sole(c, side, target);
      for (std::size_t i : {4u, 5u}) EXPECT_LT((on_toes[i] - flat[i]).norm(), 1e-12);
      for (std::size_t i : {0u, 1u, 2u, 3u}) EXPECT_GT(on_toes[i].z(), 1e-3);
      target.heel_rise = 0.0;
      target.toe_rise = pitch;
      const auto on_heel = sole(c, side, target);
      for (std::size_t i : {0u, 1u}) EXPECT_LT((on_heel[i] - flat[i]).norm(), 1e-12);
      for (std::size_t i : {2u, 3u, 4u, 5u}) EXPECT_GT(on_heel[i].z(), 1e-3);
      target.toe_rise = 0.0;
    }
  }
}

TEST(MinJerkTrack, IsTheMinimumJerkBlendBetweenRestingKnots) {
  const MinJerkTrack track({{1.0, 2.0}, {3.0, -4.0}});
  for (double s = 0.0; s <= 1.0; s += 0.1) {
    const double blend = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    EXPECT_NEAR(track.at(1.0 + 2.0 * s), 2.0 - 6.0 * blend, 1e-12);
  }
  EXPECT_EQ(track.at(0.0), 2.0);
  EXPECT_EQ(track.at(9.0), -4.0);
}

TEST(MinJerkTrack, TakesValueVelocityAndAccelerationFromBothSidesOfAKnot) {
  const Knot knot{1.3, 0.7, -1.1, 2.3};
  const MinJerkTrack track({{0.2, 0.1, 0.5, -1.0}, knot, {2.0, 0.4, 0.3, 1.0}});
  const double h = 1e-4;
  for (double side : {-1.0, 1.0}) {
    const double f0 = track.at(knot.time), f1 = track.at(knot.time + side * h),
                 f2 = track.at(knot.time + 2.0 * side * h), f3 = track.at(knot.time + 3.0 * side * h);
    EXPECT_NEAR(f0, knot.value, 1e-12);
    EXPECT_NEAR(side * (-3.0 * f0 + 4.0 * f1 - f2) / (2.0 * h), knot.velocity, 1e-5);
    EXPECT_NEAR((2.0 * f0 - 5.0 * f1 + 4.0 * f2 - f3) / (h * h), knot.acceleration, 1e-3);
  }
}

TEST(MinJerkTrack, ReproducesAParabola) {
  const auto fall = [](double t) { return 1.0 + 2.0 * t - 4.905 * t * t; };
  const MinJerkTrack track({{0.0, fall(0.0), 2.0, -9.81}, {0.4, fall(0.4), 2.0 - 9.81 * 0.4, -9.81}});
  for (double t = 0.0; t <= 0.4; t += 0.05) EXPECT_NEAR(track.at(t), fall(t), 1e-14);
}

TEST(MinJerkTrack, RejectsEmptyAndSimultaneousKnots) {
  EXPECT_THROW(MinJerkTrack(std::vector<Knot>{}), std::invalid_argument);
  EXPECT_THROW(MinJerkTrack({{1.0, 0.0}, {1.0, 2.0}}), std::invalid_argument);
}

TEST(Smoothed, KeepsConstantsAndSpreadsAnImpulseLikeAGaussian) {
  EXPECT_NEAR(smoothed(std::vector<double>(50, 3.5), 4.0)[7], 3.5, 1e-12);
  std::vector<double> impulse(101, 0.0);
  impulse[50] = 1.0;
  const std::vector<double> spread = smoothed(impulse, 3.0);
  double sum = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < spread.size(); ++i) {
    sum += spread[i];
    variance += spread[i] * std::pow(static_cast<double>(i) - 50.0, 2);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(std::sqrt(variance), 3.0, 0.01);
}

}  // namespace
}  // namespace mimicx::synth
