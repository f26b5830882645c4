#include "audit/feasibility.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/units.h"
#include "motion/reference.h"
#include "synth/synthesize.h"

namespace mimicx::audit {
namespace {

/// The T-pose, upright, its soles at `height(t)` of frame t.
template <class Height>
motion::Clip t_pose(const Height& height) {
  const Character c = make_character();
  PerBody<Quaterniond> pose;
  pose.fill(Quaterniond::Identity());
  pose[kPelvis] = exp_map(Vector3d(std::numbers::pi / 2, 0.0, 0.0));
  const BodyPoses at_origin = forward_kinematics(c, Vector3d::Zero(), pose);
  const ContactPoint& heel = c.contact_points[0];
  const int b = heel.body;
  const double sole = (at_origin.p_WB[b] + at_origin.q_WB[b] * heel.p_B).z();
  std::vector<Vector3d> p_root;
  for (int t = 0; t < 7; ++t) p_root.emplace_back(0.2, -0.1, height(t) - sole);
  return motion::to_clip("t_pose", 30.0, c, p_root, std::vector<PerBody<Quaterniond>>(p_root.size(), pose));
}

TEST(Feasibility, StandingStillHasNoResidual) {
  const Feasibility f = feasibility(t_pose([](int) { return 0.0; }));
  EXPECT_LT(f.max_force, 1e-4);
  EXPECT_LT(f.max_moment, 1e-4);
  EXPECT_LT(f.worst_torque, 0.5);
  EXPECT_EQ(f.frames_over_limit, 0);
}

TEST(Feasibility, FreeFallHasNoResidual) {
  const motion::Clip clip = t_pose([](int t) { return 1.0 - 0.5 * kGravity * t * t / 900.0; });
  const Feasibility f = feasibility(clip);
  EXPECT_LT(f.max_force, 1e-9);
  EXPECT_LT(f.max_moment, 1e-9);
  EXPECT_LT(f.worst_torque, 1e-9);
}

TEST(Feasibility, HoveringHasTheWeightAsResidual) {
  const Feasibility f = feasibility(t_pose([](int) { return 0.1; }));
  EXPECT_NEAR(f.mean_force, 1.0, 1e-9);
  EXPECT_NEAR(f.max_force, 1.0, 1e-9);
  EXPECT_LT(f.max_moment, 1e-9);
}

/// A floor can push but not pull.
TEST(Feasibility, FloorDoesNotPullInAFallFasterThanGravity) {
  const motion::Clip clip =
      t_pose([](int t) { return -0.5 * 1.5 * kGravity * (t - 3) * (t - 3) / 900.0 - 0.01; });
  const Feasibility f = feasibility(clip);
  EXPECT_NEAR(f.mean_force, 0.5, 1e-6);
}

TEST(Feasibility, HeldOutArmLoadsTheShoulderWithWeightTimesLever) {
  const motion::Clip clip = t_pose([](int) { return 0.0; });
  const Character c = make_character();
  const BodyPoses poses = motion::poses_of(clip)[3];
  const FrameDemand demand = motion_demands(clip)[2];
  Vector3d expected = Vector3d::Zero();
  for (const int b : {kLeftShoulder, kLeftElbow, kLeftWrist})
    expected += (poses.p_WB[b] + poses.q_WB[b] * c.com_B[b] - poses.p_WB[kLeftShoulder])
                    .cross(Vector3d(0.0, 0.0, kGravity * c.mass[b]));
  EXPECT_GT(expected.norm(), 3.0);
  EXPECT_LT((demand.torque[kLeftShoulder] - expected).norm(), 1e-9);
  EXPECT_NEAR(torque_ratios(c, poses, demand)[kLeftShoulder],
              expected.norm() / c.joint[kLeftShoulder].torque_limit, 1e-9);
}

TEST(Feasibility, SymmetricMotionLoadsBothKneesEqually) {
  synth::SynthConfig config;
  config.kind = "squat";
  const motion::Clip clip = synth::synthesize(config);
  const Character c = make_character(clip.betas);
  const std::vector<FrameDemand> demands = motion_demands(clip);
  for (std::size_t i = 0; i < demands.size(); i += 20) {
    const PerBody<double> ratios = torque_ratios(c, motion::poses_of(clip)[i + 1], demands[i]);
    EXPECT_NEAR(ratios[kLeftKnee], ratios[kRightKnee], 0.02);
  }
}

TEST(Feasibility, SyntheticMotionsAreFeasible) {
  for (const std::string& kind : synth::synthetic_kinds()) {
    synth::SynthConfig config;
    config.kind = kind;
    config.seed = 1;
    config.betas_from_seed = true;
    const Feasibility f = feasibility(synth::synthesize(config));
    EXPECT_LT(f.mean_force, 0.001) << kind;
    EXPECT_LT(f.mean_moment, 0.001) << kind;
    EXPECT_LT(f.max_force, 0.02) << kind;
    EXPECT_LT(f.max_moment, 0.03) << kind;
    EXPECT_LT(f.worst_torque, 1.0) << kind;
  }
}

TEST(Feasibility, OfAnotherModelIsThatOfTheBodyThatStandsForIt) {
  const motion::Clip clip = t_pose([](int) { return 0.0; });
  motion::Clip model, other = clip;
  model.body_model = "smplh";
  motion::put_on_body_of(model, other);
  const std::vector<FrameDemand> ours = motion_demands(clip), theirs = motion_demands(other);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t t = 0; t < ours.size(); ++t) {
    EXPECT_LT((ours[t].residual_force - theirs[t].residual_force).norm(), 1e-6);
    EXPECT_LT((ours[t].torque[kLeftShoulder] - theirs[t].torque[kLeftShoulder]).norm(), 1e-6);
  }
}

TEST(Feasibility, RejectsClipsOfFewerThanThreeFrames) {
  motion::Clip clip = t_pose([](int) { return 0.0; });
  clip.rotations.resize(2);
  clip.trans.resize(2);
  EXPECT_THROW(feasibility(clip), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::audit
