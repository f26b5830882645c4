#include "files/recorded_forces.h"

#include <gtest/gtest.h>

#include "files/pushed_clip.h"

namespace mimicx::files {
namespace {

TEST(FloorForces, AreThoseOfThePushesThatMakeThemUp) {
  const motion::Clip clip = pushed_clip(9);
  const List<FloorForces> floor = floor_forces(motion::poses_of(clip), *recorded_forces(clip));
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

TEST(FloorForces, ForcePointAndFreeMomentAreTheWholeWrench) {
  const motion::Clip clip = pushed_clip(6);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  RecordedForces forces = *recorded_forces(clip);
  for (int t = 1; t < 6; ++t)  // as under the floor's surface: no pushes at z = 0 would give these
    forces.ground[t][kRightAnkle].head<3>() += Vector3d(3.0, -2.0, 1.0);
  const List<FloorForces> floor = floor_forces(poses, forces);
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

TEST(FloorForces, AFootInTheAirHasItsPointUnderItself) {
  const motion::Clip clip = pushed_clip(5);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const FloorForce left = floor_forces(poses, *recorded_forces(clip))[2][kOnLeftFoot];
  EXPECT_FALSE(left.loaded);
  Vector3d foot = 0.25 * (poses[2].p_WB[kLeftAnkle] + poses[3].p_WB[kLeftAnkle] + poses[2].p_WB[kLeftFoot] +
                          poses[3].p_WB[kLeftFoot]);
  foot.z() = 0.0;
  EXPECT_LT((left.point - foot).norm(), 1e-12);
}

TEST(RecordedForces, HalfOfThemIsAnErrorAndNoneIsNone) {
  EXPECT_FALSE(recorded_forces(turning_clip(4)).has_value());
  for (const std::size_t gone : {0u, 1u}) {
    motion::Clip clip = pushed_clip(4);
    clip.passthrough.erase(clip.passthrough.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_THROW(recorded_forces(clip), DataError);
  }
  motion::Clip clip = pushed_clip(4);
  clip.rotations.resize(3);
  clip.trans.resize(3);
  EXPECT_THROW(recorded_forces(clip), DataError) << "forces of another number of frames";
}

}  // namespace
}  // namespace mimicx::files
