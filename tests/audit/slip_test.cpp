#include "audit/slip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/units.h"
#include "import/motion_file.h"
#include "motion/standing_clip.h"
#include "synth/synthesize.h"

namespace mimicx::audit {
namespace {

constexpr double kWeight = 700.0;

/// A body at rest in the pose of the standing clip, whose feet are moved by the tests.
PerFrame<BodyPoses> standing(int frames) {
  const motion::Clip clip = motion::standing_clip(1);
  return {frames, motion::poses_of(clip)[0]};
}

FloorWrenches no_wrenches(int frames) {
  FloorWrenches ground(frames);
  for (auto& frame : ground) frame.fill(Vector6d::Zero());
  return ground;
}

/// A force on a body at a point of the world, about its joint centre.
void push(const BodyPoses& poses, int body, const Vector3d& p, const Vector3d& force,
          PerBody<Vector6d>& ground) {
  ground[body].head<3>() += (p - poses.p_WB[body]).cross(force);
  ground[body].tail<3>() += force;
}

/// The whole motion moves by `step` in each frame, and may be lifted.
PerFrame<BodyPoses> shifted_by(PerFrame<BodyPoses> poses, const Vector3d& step,
                               const Vector3d& lift = Vector3d::Zero()) {
  for (int t = 0; t < poses.count(); ++t)
    for (Vector3d& p : poses[t].p_WB) p += t * step + lift;
  return poses;
}

TEST(Slip, IsTheSpeedOfAUniformSlide) {
  const PerFrame<BodyPoses> poses = shifted_by(standing(10), {0.003, 0.004, 0.0});
  FloorWrenches ground = no_wrenches(10);
  for (int t = 1; t < 10; ++t) push(poses[t], kLeftAnkle, {0.1, 0.2, 0.0}, {30.0, -50.0, 400.0}, ground[t]);
  const Slip slip = slip_of(poses, ground, kWeight, 30.0);
  EXPECT_NEAR(slip.mean, 5.0, 1e-9);
  EXPECT_EQ(slip.share, 100.0);
  EXPECT_EQ(slip.loaded, 9);
  EXPECT_TRUE(std::isnan(slip.speed[0]));
  EXPECT_NEAR(slip.speed[9], 5.0, 1e-9);
  EXPECT_NEAR(slip_of(poses, ground, kWeight, 60.0).mean, 10.0, 1e-9) << "the same way in half the time";
}

TEST(Slip, IsThatOfTheMaterialPointAtTheCentreOfPressure) {
  const double angle = 0.02, arm = 0.15;  // the foot turns on the floor about a point `arm` away
  PerFrame<BodyPoses> poses = standing(2);
  const Vector3d pivot(0.3, -0.2, 0.0);
  poses[1].q_WB[kRightFoot] = exp_map(Vector3d(0.0, 0.0, angle)) * poses[0].q_WB[kRightFoot];
  poses[1].p_WB[kRightFoot] =
      pivot + exp_map(Vector3d(0.0, 0.0, angle)) * (poses[0].p_WB[kRightFoot] - pivot);
  for (const double away : {0.0, arm}) {
    FloorWrenches ground = no_wrenches(2);
    push(poses[1], kRightFoot, pivot + Vector3d(0.0, away, 0.0), {10.0, 20.0, 300.0}, ground[1]);
    EXPECT_NEAR(slip_of(poses, ground, kWeight, 30.0).mean, kMm * 2.0 * away * std::sin(angle / 2), 1e-9);
  }
}

TEST(Slip, RollingFootDoesNotSlip) {
  // A heel of radius r rolls: its centre advances by r·φ, and the point on the floor stays.
  const double r = 0.05, step = 1e-3;
  PerFrame<BodyPoses> poses = standing(3);
  FloorWrenches ground = no_wrenches(3);
  for (int t = 0; t < 3; ++t) {
    poses[t].p_WB[kLeftAnkle] = {r * step * t, 0.0, r};
    poses[t].q_WB[kLeftAnkle] = exp_map(Vector3d(0.0, step * t, 0.0));
    push(poses[t], kLeftAnkle, {r * step * t, 0.0, 0.0}, {0.0, 0.0, 500.0}, ground[t]);
  }
  EXPECT_NEAR(slip_of(poses, ground, kWeight, 30.0).mean, 0.0, kMm * r * step * step);
}

TEST(Slip, FeetCountByTheirLoad) {
  PerFrame<BodyPoses> poses = standing(5);
  FloorWrenches ground = no_wrenches(5);
  for (int t = 0; t < 5; ++t) {
    poses[t].p_WB[kLeftAnkle].x() += 0.006 * t;
    push(poses[t], kLeftAnkle, {0.0, 0.0, 0.0}, {0.0, 0.0, 150.0}, ground[t]);
    push(poses[t], kRightAnkle, {0.0, 0.1, 0.0}, {0.0, 0.0, 450.0}, ground[t]);
    push(poses[t], kLeftWrist, {0.5, 0.1, 0.0}, {0.0, 0.0, 450.0}, ground[t]);  // a hand does not count
  }
  const Slip slip = slip_of(poses, ground, kWeight, 30.0);
  EXPECT_NEAR(slip.mean, 6.0 / 4.0, 1e-9);
  EXPECT_EQ(slip.share, 50.0);
}

TEST(Slip, UnloadedFeetDoNotCount) {
  const PerFrame<BodyPoses> poses = shifted_by(standing(5), {0.02, 0.0, 0.0});
  FloorWrenches ground = no_wrenches(5);
  for (int t = 1; t < 5; ++t)
    push(poses[t], kLeftAnkle, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.049 * kWeight}, ground[t]);
  const Slip slip = slip_of(poses, ground, kWeight, 30.0);
  EXPECT_EQ(slip.loaded, 0);
  EXPECT_TRUE(std::isnan(slip.mean));
  EXPECT_TRUE(std::isnan(slip.share));
  EXPECT_THROW(slip_of(poses, no_wrenches(4), kWeight, 30.0), std::invalid_argument);
}

motion::Clip exact_clip(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 501;
  return synth::synthesize(config);
}

TEST(BestFloorForces, CarryABodyThatStands) {
  const Character c = make_character();
  const PerFrame<BodyPoses> poses = standing(8);
  const int loaded = slip_of_poses(c, poses, 30.0, {}, kGravity).loaded;
  for (const double gravity : {kGravity, 1.62}) {
    const FloorWrenches ground = best_floor_forces(c, poses, 30.0, {}, gravity).ground;
    const double weight = gravity * c.total_mass();
    for (int t = 1; t < ground.count(); ++t) {
      double up = 0.0;
      for (const Vector6d& wrench : ground[t]) up += wrench[5];
      EXPECT_NEAR(up, weight, 1e-3 * weight) << t;
    }
    const Slip slip = slip_of_poses(c, poses, 30.0, {}, gravity);
    EXPECT_NEAR(slip.mean, 0.0, 1e-9);
    EXPECT_EQ(slip.loaded, loaded) << "a foot is loaded by its part of the weight";
  }
}

TEST(BestFloorForces, SlidingBodySlipsAtItsSpeedAtAnyHeight) {
  const Character c = make_character();
  for (const double height : {0.0, 0.6, -0.3}) {
    const auto poses = shifted_by(standing(12), {0.004, 0.0, 0.0}, {0.0, 0.0, height});
    const Slip slip = slip_of_poses(c, poses, 30.0, {}, kGravity);
    EXPECT_NEAR(slip.mean, 4.0, 1e-6) << height;
    EXPECT_EQ(slip.share, 100.0) << height;
  }
}

// Feet that roll and turn: their pressure is on the floor that the motion stands on, not on z = 0.
TEST(BestFloorForces, SlipDoesNotDependOnTheHeightOfTheMotion) {
  const motion::Clip clip = exact_clip("walk");
  const Character c = motion::character_of(clip);
  const Slip low = slip_of_poses(c, motion::poses_of(clip), clip.fps, {}, kGravity);
  for (const double height : {0.5, -0.3}) {
    const auto poses = shifted_by(motion::poses_of(clip), Vector3d::Zero(), {0.0, 0.0, height});
    const Slip slip = slip_of_poses(c, poses, clip.fps, {}, kGravity);
    EXPECT_NEAR(slip.mean, low.mean, 1e-3) << height;  // points at the edge of the reach may change sides
    EXPECT_NEAR(slip.loaded, low.loaded, 0.01 * low.loaded) << height;
  }
}

// Estimators and motion capture let the toes of a swinging foot dip into the floor.
TEST(BestFloorForces, ToesOfASwingingFootAreNotTheFloor) {
  const motion::Clip clip = exact_clip("walk");
  const Character c = motion::character_of(clip);
  PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const Slip clean = slip_of_poses(c, poses, clip.fps, {}, kGravity);
  for (int t = 1; t < poses.count(); ++t)
    for (const int foot : {kLeftFoot, kRightFoot})
      if ((poses[t].p_WB[foot] - poses[t - 1].p_WB[foot]).head<2>().norm() * clip.fps > 1.0)
        poses[t].p_WB[foot].z() -= 0.03 + std::max(0.0, poses[t].p_WB[foot].z() - 0.02);
  const Slip dipped = slip_of_poses(c, poses, clip.fps, {}, kGravity);
  EXPECT_GT(dipped.loaded, 0.8 * clean.loaded);
  EXPECT_LT(dipped.mean, clean.mean + 0.5);
}

TEST(BestFloorForces, FallingBodyLoadsNothing) {
  PerFrame<BodyPoses> poses = standing(12);
  for (int t = 0; t < 12; ++t)
    for (Vector3d& p : poses[t].p_WB) p += Vector3d(0.05 * t, 0.0, -0.5 * kGravity * t * t / 900.0);
  EXPECT_EQ(slip_of_poses(make_character(), poses, 30.0, {}, kGravity).loaded, 0);
}

TEST(BestFloorForces, ExactMotionsHardlySlip) {
  for (const char* kind : {"walk", "squat", "kick", "jump"}) {
    const motion::Clip clip = exact_clip(kind);
    const Slip slip =
        slip_of_poses(motion::character_of(clip), motion::poses_of(clip), clip.fps, {}, kGravity);
    EXPECT_LT(slip.mean, 0.1) << kind;
    EXPECT_LT(slip.share, 2.5) << kind;
    EXPECT_GT(slip.loaded, clip.frames()) << kind;
  }
}

TEST(BestFloorForces, OfFewerThanThreeFramesAreZero) {
  EXPECT_EQ(slip_of_poses(make_character(), standing(2), 30.0, {}, kGravity).loaded, 0);
}

/// The feet of a real walk, loaded by hand: 300 N at each ankle and 100 N at each ball, straight down.
TEST(Slip, AgreesWithAnIndependentScriptOnARealWalk) {
  const std::filesystem::path file =
      std::filesystem::path(MIMICX_SHARED_DIR) / "motions/video/video_walk_level1_filter_amass.npz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const motion::Clip clip = import::read_motion(file);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  FloorWrenches ground = no_wrenches(poses.count());
  for (PerBody<Vector6d>& frame : ground) {
    frame[kLeftAnkle] << 0.0, 0.0, 0.0, 20.0, 0.0, 300.0;
    frame[kRightAnkle] << 0.0, 0.0, 0.0, 0.0, -20.0, 300.0;
    frame[kLeftFoot][5] = frame[kRightFoot][5] = 100.0;
  }
  const Slip slip = slip_of(poses, ground, 800.0, clip.fps);
  EXPECT_NEAR(slip.mean, 13.77835, 1e-4);
  EXPECT_NEAR(slip.share, 33.77483, 1e-4);
}

}  // namespace
}  // namespace mimicx::audit
