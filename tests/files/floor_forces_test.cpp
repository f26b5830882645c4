#include "files/floor_forces.h"

#include <gtest/gtest.h>

#include <random>

#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

BodyPoses standing_poses() {
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

TEST(FloorArrows, OneForceActsAtItsPoint) {
  const BodyPoses poses = standing_poses();
  PerBody<Vector6d> wrenches = none();
  const Vector3d point(1.1, -1.9, 0.0), force(30.0, -20.0, 500.0);
  push(poses, kLeftFoot, point, force, wrenches);
  const FloorArrows arrows = floor_arrows(wrenches, poses, {});
  EXPECT_NEAR((arrows[0].point - point).norm(), 0.0, 1e-12);
  EXPECT_NEAR((arrows[0].force - force).norm(), 0.0, 1e-12);
  EXPECT_EQ(arrows[1].force, Vector3d::Zero());
  EXPECT_EQ(arrows[2].force, Vector3d::Zero());
}

TEST(FloorArrows, PointIsOnThePlateUnderTheFoot) {
  BodyPoses poses = standing_poses();
  const double up = 0.4 - 0.008;  // the plate gives way under the foot
  for (Vector3d& p : poses.p_WB) p.z() += up;
  const Scene scene{{{{1.0, -2.0}, 0.2, {0.6, 0.6}, 0.4}}};
  PerBody<Vector6d> wrenches = none();
  const Vector3d point(1.1, -1.9, 0.4), force(30.0, -20.0, 500.0);
  push(poses, kLeftFoot, point, force, wrenches);
  EXPECT_NEAR((floor_arrows(wrenches, poses, scene)[0].point - point).norm(), 0.0, 1e-12);
  EXPECT_GT((floor_arrows(wrenches, poses, {})[0].point - point).norm(), 0.01);
}

// Of forces straight up the centre of pressure is the mean of their points, weighted by the forces.
TEST(FloorArrows, FootsPointIsTheMeanOfItsContactsWeightedByForce) {
  const BodyPoses poses = standing_poses();
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
  const FloorArrows arrows = floor_arrows(wrenches, poses, {});
  EXPECT_NEAR((arrows[1].point - sum / total).norm(), 0.0, 1e-12);
  EXPECT_NEAR(arrows[1].force.z(), total, 1e-9);
}

TEST(FloorArrows, HandsAddToTheThirdArrow) {
  const BodyPoses poses = standing_poses();
  PerBody<Vector6d> wrenches = none();
  push(poses, kLeftWrist, {0.2, 0.1, 0.0}, {0.0, 0.0, 40.0}, wrenches);
  EXPECT_EQ(floor_arrows(wrenches, poses, {})[2].force.z(), 40.0);
}

// The centre of pressure of a tiny force is not defined.
TEST(FloorArrows, TinyForceHasNoArrow) {
  const BodyPoses poses = standing_poses();
  PerBody<Vector6d> wrenches = none();
  push(poses, kLeftFoot, {0.0, 0.0, 0.0}, {5.0, 0.0, 1e-9}, wrenches);
  EXPECT_EQ(floor_arrows(wrenches, poses, {})[0].force, Vector3d::Zero());
}

TEST(FloorForces, SumThePushesOnTheCarrier) {
  const motion::Clip clip = pushed_clip(9);
  const List<FloorForces> floor = floor_forces(motion::poses_of(clip), *recorded_forces(clip), {});
  ASSERT_EQ(floor.count(), 8);
  for (int t = 1; t < 9; ++t)
    for (const Carrier c : {kOnRightFoot, kOnLeftFoot, kOnTheRest}) {
      const FloorForce expected = sum_of_pushes(t, c), &found = floor[t - 1][c];
      EXPECT_EQ(found.loaded, expected.loaded) << t << ' ' << c;
      EXPECT_LT((found.force - expected.force).norm(), 1e-9);
      if (!expected.loaded) continue;
      EXPECT_LT((found.point - expected.point).norm(), 1e-9) << t << ' ' << c;
      EXPECT_NEAR(found.free_moment, expected.free_moment, 1e-9);
    }
}

TEST(FloorForces, ForcePointAndFreeMomentGiveTheWholeWrench) {
  const motion::Clip clip = pushed_clip(6);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  RecordedForces forces = *recorded_forces(clip);
  for (int t = 1; t < 6; ++t)  // as under the floor's surface: no pushes at z = 0 would give these
    forces.ground[t][kRightAnkle].head<3>() += Vector3d(3.0, -2.0, 1.0);
  const List<FloorForces> floor = floor_forces(poses, forces, {});
  const Vector3d about(0.3, -0.8, 1.1);
  for (int t = 1; t < 6; ++t) {
    Vector3d moment = Vector3d::Zero(), again = Vector3d::Zero();
    for (int b = 0; b < kBodies; ++b) {
      const Vector3d joint = 0.5 * (poses[t - 1].p_WB[b] + poses[t].p_WB[b]);
      moment +=
          forces.ground[t][b].head<3>() + (joint - about).cross(Vector3d(forces.ground[t][b].tail<3>()));
    }
    for (const FloorForce& f : floor[t - 1])
      again += (f.point - about).cross(f.force) + f.free_moment * Vector3d::UnitZ();
    EXPECT_LT((again - moment).norm(), 1e-9);
  }
}

TEST(FloorForces, UnloadedFootsPointIsUnderTheFoot) {
  const motion::Clip clip = pushed_clip(5);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const FloorForce left = floor_forces(poses, *recorded_forces(clip), {})[2][kOnLeftFoot];
  EXPECT_FALSE(left.loaded);
  Vector3d foot = 0.25 * (poses[2].p_WB[kLeftAnkle] + poses[3].p_WB[kLeftAnkle] + poses[2].p_WB[kLeftFoot] +
                          poses[3].p_WB[kLeftFoot]);
  foot.z() = 0.0;
  EXPECT_LT((left.point - foot).norm(), 1e-12);
}

}  // namespace
}  // namespace mimicx::files
