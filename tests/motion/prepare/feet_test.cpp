#include "motion/prepare/feet.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "motion/made_motions.h"
#include "motion/prepare/prepare.h"
#include "synth/synthesize.h"

namespace mimicx::motion {
namespace {

Clip walk() {
  synth::SynthConfig config;
  config.kind = "walk";
  config.seed = 3;
  return synth::synthesize(config);
}

TEST(Feet, ExactMotionsStayUnchanged) {
  for (const std::string& kind : synth::synthetic_kinds()) {
    synth::SynthConfig config;
    config.kind = kind;
    PreparationConfig without_planting;  // foot_planting_test.cpp
    without_planting.plant = false;
    PreparationReport report;
    prepare_reference(synth::synthesize(config), without_planting, &report);
    EXPECT_EQ(report.foot_level_deg, 0.0) << kind;
    EXPECT_LT(report.change_max_mm, 0.5) << kind;
  }
}

TEST(Feet, RemovesAConstantErrorOfTheFeet) {
  const Reference exact = prepare_reference(walk(), {}, nullptr);
  for (const Vector3d& error : {Vector3d(15 * kDegree, 0, 0), Vector3d(-12 * kDegree, 0, 5 * kDegree)}) {
    PreparationReport report;
    const Reference levelled = prepare_reference(test::with_turned_feet(walk(), error), {}, &report);
    EXPECT_NEAR(report.foot_level_deg, error.norm() / kDegree, 1.0);
    double worst = 0.0;
    for (std::size_t t = 0; t < exact.poses.size(); ++t)
      for (std::size_t i = 0; i < kBodies; ++i)
        worst = std::max(worst, (levelled.poses[t].p_WB[i] - exact.poses[t].p_WB[i]).norm());
    EXPECT_LT(worst, 0.015);

    PreparationConfig off;
    off.level_feet = false;
    const Reference raw = prepare_reference(test::with_turned_feet(walk(), error), off, nullptr);
    double raw_worst = 0.0;
    for (std::size_t t = 0; t < exact.poses.size(); ++t)
      raw_worst = std::max(raw_worst, (raw.poses[t].p_WB[kLeftFoot] - exact.poses[t].p_WB[kLeftFoot]).norm());
    EXPECT_GT(raw_worst, 0.02) << "the error is large enough for the test to mean something";
  }
}

/// Prepared as if nothing were wrong with feet and floor.
PreparationConfig unlevelled() {
  PreparationConfig config;
  config.level_feet = config.ground = config.plant = config.ranges = false;
  return config;
}

/// A standing body whose ankles are turned by `rotation` in frames 30 to 69 of 100.
Clip turned_for_a_while(const Vector3d& rotation) {
  Clip clip = test::standing_clip(100, test::standing_height());
  const Clip turned = test::with_turned_feet(clip, rotation);
  for (int t = 30; t < 70; ++t) clip.rotations[t] = turned.rotations[t];
  return clip;
}

/// Largest angle of the left sole from level, degrees, in frames a, a + 1, …, b − 1.
double largest_tilt(const Reference& reference, int a, int b) {
  double largest = 0.0;
  for (int t = a; t < b; ++t) {
    const Vector3d up = reference.poses[t].q_WB[kLeftAnkle] * Vector3d::UnitY();
    largest = std::max(largest, angle_between(up, Vector3d::UnitZ()) / kDegree);
  }
  return largest;
}

TEST(Feet, RollIsRemovedWhereItIs) {
  Reference r = prepare_reference(turned_for_a_while({0, 0, 25 * kDegree}), unlevelled(), nullptr);
  ASSERT_GT(largest_tilt(r, 30, 70), 20.0);
  EXPECT_NEAR(level_feet(r), 25.0, 1.0);
  for (int t = 0; t < r.size(); ++t)
    r.poses[t] = forward_kinematics(r.character, r.frames[t].p_root, r.frames[t].q);
  EXPECT_LT(largest_tilt(r, 0, 20), 0.1);
  EXPECT_LT(largest_tilt(r, 40, 60), 0.1);
  EXPECT_LT(largest_tilt(r, 80, 100), 0.1);
}

TEST(Feet, HeelThatIsUpForAWhileTurnsNoOtherFrame) {
  Clip clip = turned_for_a_while({20 * kDegree, 0, 0});
  for (int t = 10; t < 30; ++t) clip.rotations[t] = clip.rotations[30];  // six tenths of the frames
  Reference r = prepare_reference(clip, unlevelled(), nullptr);
  ASSERT_GT(largest_tilt(r, 10, 70), 15.0);
  EXPECT_EQ(level_feet(r), 0.0);
}

TEST(Feet, FootThatSwingsThroughABoxIsOnItAndOneThatStandsInItIsNot) {
  const Reference r = prepare_reference(walk(), {}, nullptr);
  const std::vector<SurfacePoint> points = surface_points(r.character);
  const auto left = standing_frames(r.poses, kLeftAnkle, r.fps);
  int swung = -1, stood = -1;
  for (int t = 20; t + 20 < r.size(); ++t) {
    const double z = r.poses[t].p_WB[kLeftFoot].z();
    if (!left[t] && (swung < 0 || z > r.poses[swung].p_WB[kLeftFoot].z())) swung = t;
    if (left[t] && stood < 0) stood = t;
  }
  ASSERT_GE(std::min(swung, stood), 0);
  const auto box_at = [&](int t) {
    const Vector3d& p = r.poses[t].p_WB[kLeftFoot];
    return Scene{{{{p.x(), p.y()}, 0.0, {0.04, 0.04}, p.z() + 0.02}}};
  };
  const Scene in_the_way = box_at(swung), under = box_at(stood);
  EXPECT_LT(lowest_height(points, r.poses[swung], in_the_way), -0.02);
  EXPECT_GT(standing_heights(points, r.poses, r.fps, in_the_way)[swung], -0.002);
  EXPECT_LT(lowest_height(points, r.poses[stood], under), -0.02);
  EXPECT_EQ(standing_heights(points, r.poses, r.fps, under)[stood],
            lowest_height(points, r.poses[stood], under));
}

TEST(Feet, StandingFramesAreThoseOfTheStanceFoot) {
  const Reference r = prepare_reference(walk(), {}, nullptr);
  const auto left = standing_frames(r.poses, kLeftAnkle, r.fps),
             right = standing_frames(r.poses, kRightAnkle, r.fps);
  int both = 0, none = 0;
  for (std::size_t t = 0; t < left.size(); ++t) {
    both += left[t] && right[t];
    none += !left[t] && !right[t];
  }
  EXPECT_GT(both, 20) << "stands before and after the walk";
  EXPECT_LT(none, static_cast<int>(left.size()) / 5) << "a walk has a foot on the floor";
}

TEST(Feet, BendsToesBelowTheFloorOntoIt) {
  Reference r = prepare_reference(walk(), {}, nullptr);
  // Heel up by 40° about the ball of the left foot, toes stiff: their tips are far below the floor.
  ReferenceFrame& frame = r.frames[0];
  const Vector3d ball = r.poses[0].p_WB[kLeftFoot];
  frame.q[kLeftAnkle] = frame.q[kLeftAnkle] * exp_map(Vector3d(40 * kDegree, 0, 0));
  r.poses[0] = forward_kinematics(r.character, frame.p_root, frame.q);
  frame.p_root.z() += ball.z() - r.poses[0].p_WB[kLeftFoot].z();
  r.poses[0] = forward_kinematics(r.character, frame.p_root, frame.q);
  const auto tips = [&] {
    double lowest = 1.0;
    for (const ContactPoint& point : r.character.contact_points)
      if (point.body == kLeftFoot)
        lowest = std::min(lowest, (r.poses[0].p_WB[kLeftFoot] + r.poses[0].q_WB[kLeftFoot] * point.p_B).z());
    return lowest;
  };
  ASSERT_LT(tips(), -0.02);
  const auto before = r.poses[0];
  bend_toes(r);
  r.poses[0] = forward_kinematics(r.character, frame.p_root, frame.q);
  EXPECT_NEAR(tips(), 0.0, 1e-6);
  for (std::size_t i = 0; i < kBodies; ++i) EXPECT_LT((r.poses[0].p_WB[i] - before.p_WB[i]).norm(), 1e-12);
}

}  // namespace
}  // namespace mimicx::motion
