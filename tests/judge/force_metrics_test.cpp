#include "judge/force_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "audit/thrown.h"
#include "core/units.h"
#include "files/archive_members.h"
#include "judge/scores.h"
#include "motion/standing_clip.h"

namespace mimicx::judge {
namespace {

/// Stands and glides by 5 mm in a frame.
motion::Clip gliding(int frames) {
  motion::Clip clip = motion::standing_clip(frames);
  for (int t = 0; t < frames; ++t) clip.trans[t].y() += 0.005 * t;
  return clip;
}

motion::Metrics judged(const motion::Clip& clip) {
  motion::Metrics metrics;
  judge_clip(clip, metrics);
  return metrics;
}

void record_forces(motion::Clip& clip, const Vector6d& on_left_foot) {
  PerBody<Vector6d> frame;
  frame.fill(Vector6d::Zero());
  frame[kLeftAnkle] = on_left_foot;
  PerBody<Vector3d> no_torque;
  no_torque.fill(Vector3d::Zero());
  const auto n = static_cast<std::size_t>(clip.frames());
  const auto precision = files::Precision::kFloat64;
  clip.passthrough.emplace_back("ground_wrenches",
                                files::wrenches_member(files::WrenchRows(n, frame), precision));
  clip.passthrough.emplace_back("joint_torques",
                                files::joints_member(files::VectorRows(n, no_torque), precision));
}

TEST(ForceMetrics, PosesAreJudgedByTheirBestForces) {
  const motion::Metrics metrics = judged(gliding(12));
  EXPECT_NEAR(metrics.slip.value, 5.0, 0.1);
  EXPECT_GT(metrics.slip.count, 11u);
  EXPECT_EQ(metrics.slip_share.value, 100.0);
  EXPECT_TRUE(std::isnan(metrics.chatter.value));
}

TEST(ForceMetrics, RecordedForcesDecideWhichFootIsLoaded) {
  motion::Clip clip = gliding(12);
  clip.rotations[6][kLeftAnkle] = {0.0, 0.0, 0.0};
  record_forces(clip, (Vector6d() << 0.0, 0.0, 0.0, 0.0, 0.0, 500.0).finished());
  EXPECT_EQ(judged(clip).slip.count, 11u);
  EXPECT_NEAR(judged(clip).slip.value, 5.0, 1e-6);
  EXPECT_NEAR(judged(clip).chatter.value, 0.0, 1e-9);
  motion::Clip unloaded = gliding(12);
  record_forces(unloaded, Vector6d::Zero());
  EXPECT_TRUE(std::isnan(judged(unloaded).slip.value));
}

// On the Moon 14 N carry an eighth of a body, on Earth next to nothing.
TEST(ForceMetrics, LoadsAreInTheWeightOfTheSimulation) {
  motion::Clip clip = gliding(12);
  const double mass = motion::character_of(clip).total_mass();
  record_forces(clip, (Vector6d() << 0.0, 0.0, 0.0, 0.0, 0.0, 0.02 * kGravity * mass).finished());
  EXPECT_TRUE(std::isnan(judged(clip).slip.value));
  clip.passthrough.emplace_back("body_weight", NpyArray::scalar(1.62 * mass));
  EXPECT_NEAR(judged(clip).slip.value, 5.0, 1e-6);
}

TEST(ForceMetrics, ScoresOfSimulatedMotionsHaveThem) {
  const audit::Thrown thrown;
  const NamedValues values = score_simulated(thrown.reference, thrown.rollout).values;
  const audit::FloorWrenches ground = ground_of(thrown.rollout);
  const double weight = kGravity * thrown.reference.character.total_mass();
  const audit::Slip slip =
      audit::slip_of(poses_of(thrown.reference.character, thrown.rollout), ground, weight, 30.0);
  EXPECT_GT(slip.mean, 0.0);
  EXPECT_EQ(value_of(values, "slip"), slip.mean);
  EXPECT_EQ(value_of(values, "slip_share"), slip.share);
  EXPECT_GT(value_of(values, "chatter"), 1.0) << "a body that thrashes";
  EXPECT_EQ(vertical_forces(ground).count(), ground.count() - 1);
}

}  // namespace
}  // namespace mimicx::judge
