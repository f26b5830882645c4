#include "report/ground_forces.h"

#include <gtest/gtest.h>

#include <random>

namespace mimicx::report {
namespace {

BodyPoses standing() {
  PerBody<Quaterniond> q;
  q.fill(Quaterniond::Identity());
  q[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.3));
  return forward_kinematics(make_character(), {1.0, -2.0, 0.95}, q);
}

/// Adds what a force at a point does to a body, as the simulator says it: about the body's joint centre.
void push(const BodyPoses& poses, int body, const Vector3d& point, const Vector3d& force,
          PerBody<Vector6d>& wrenches) {
  wrenches[body].head<3>() += (point - poses.p_WB[body]).cross(force);
  wrenches[body].tail<3>() += force;
}

PerBody<Vector6d> none() {
  PerBody<Vector6d> wrenches;
  wrenches.fill(Vector6d::Zero());
  return wrenches;
}

TEST(GroundForces, OneForceActsWhereItIs) {
  const BodyPoses poses = standing();
  PerBody<Vector6d> wrenches = none();
  const Vector3d point(1.1, -1.9, 0.0), force(30.0, -20.0, 500.0);
  push(poses, kLeftFoot, point, force, wrenches);
  const GroundForces arrows = ground_forces(wrenches, poses);
  EXPECT_NEAR((arrows[0].point - point).norm(), 0.0, 1e-12);
  EXPECT_NEAR((arrows[0].force - force).norm(), 0.0, 1e-12);
  EXPECT_EQ(arrows[1].force, Vector3d::Zero());
  EXPECT_EQ(arrows[2].force, Vector3d::Zero());
}

// Of forces straight up the centre of pressure is the mean of their points, weighted by the forces.
TEST(GroundForces, ThatOfAFootIsTheWeightedMeanOfItsPoints) {
  const BodyPoses poses = standing();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0), size(1.0, 200.0);
  PerBody<Vector6d> wrenches = none();
  Vector3d sum = Vector3d::Zero();
  double total = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double x = place(random), y = place(random), f = size(random);
    push(poses, k % 2 == 0 ? kRightAnkle : kRightFoot, {x, y, 0.0}, {0.0, 0.0, f}, wrenches);
    sum += f * Vector3d(x, y, 0.0);
    total += f;
  }
  const GroundForces arrows = ground_forces(wrenches, poses);
  EXPECT_NEAR((arrows[1].point - sum / total).norm(), 0.0, 1e-12);
  EXPECT_NEAR(arrows[1].force.z(), total, 1e-9);
}

TEST(GroundForces, HandsPushTheThirdArrow) {
  const BodyPoses poses = standing();
  PerBody<Vector6d> wrenches = none();
  push(poses, kLeftWrist, {0.2, 0.1, 0.0}, {0.0, 0.0, 40.0}, wrenches);
  EXPECT_EQ(ground_forces(wrenches, poses)[2].force.z(), 40.0);
}

// There the quotient means nothing.
TEST(GroundForces, AFloorThatHardlyPushesHasNoArrow) {
  const BodyPoses poses = standing();
  PerBody<Vector6d> wrenches = none();
  push(poses, kLeftFoot, {0.0, 0.0, 0.0}, {5.0, 0.0, 1e-9}, wrenches);
  EXPECT_EQ(ground_forces(wrenches, poses)[0].force, Vector3d::Zero());
}

}  // namespace
}  // namespace mimicx::report
