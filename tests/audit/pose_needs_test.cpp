#include "audit/pose_needs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "audit/body_loads.h"
#include "audit/feasibility.h"
#include "audit/pose_files.h"
#include "audit/pose_verdict.h"
#include "audit/slip.h"
#include "audit/thrown.h"
#include "core/temporary_folder.h"
#include "core/units.h"
#include "files/recorded_forces.h"
#include "judge/force_metrics.h"
#include "motion/clip_file.h"
#include "motion/raised_clip.h"
#include "motion/resample.h"
#include "motion/standing_clip.h"
#include "motion/uneven_joints.h"
#include "physics/inverse_dynamics.h"
#include "synth/synthesize.h"

namespace mimicx::audit {
namespace {

motion::Clip exact(const std::string& kind) {
  synth::SynthConfig config;
  config.kind = kind;
  config.seed = 501;
  config.betas_from_seed = true;
  return synth::synthesize(config);
}

PoseNeeds needs_of(const motion::Clip& clip, const PoseNeedsConfig& config = {}) {
  return needs_of_poses(motion::character_of(clip), motion::poses_of(clip), clip.fps, config);
}

/// The poses with every body moved by a rotation about the origin and a shift.
PerFrame<BodyPoses> moved(PerFrame<BodyPoses> poses, const Quaterniond& turn, const Vector3d& shift) {
  for (BodyPoses& frame : poses)
    for (int b = 0; b < kBodies; ++b) {
      frame.p_WB[b] = turn * frame.p_WB[b] + shift;
      frame.q_WB[b] = turn * frame.q_WB[b];
    }
  return poses;
}

double lowest(const Character& c, const PerFrame<BodyPoses>& poses) {
  double z = HUGE_VAL;
  for (const BodyPoses& frame : poses) z = std::min(z, lowest_contact(c, frame));
  return z;
}

// A jump, slowed down: in flight it falls with the gravity of another place.
TEST(PoseNeeds, JumpAtAThirdOfTheSpeedIsFeasibleUnderANinthOfGravity) {
  motion::Clip clip = exact("jump");
  clip.fps /= 3.0;
  EXPECT_FALSE(infeasible_stretches(needs_of(clip)).empty());
  const PoseNeeds needs = needs_of(clip, {.gravity = kGravity / 9.0});
  EXPECT_TRUE(infeasible_stretches(needs).empty());
  EXPECT_NEAR(needs.weight, kGravity / 9.0 * needs.mass, 1e-9);
}

TEST(PoseNeeds, ExactMotionsNeedLessThanAThousandthOfTheWeight) {
  for (const std::string& kind : synth::synthetic_kinds()) {
    const PoseNeeds needs = needs_of(exact(kind));
    for (const PoseNeed& need : needs.frames) {
      EXPECT_LT(need.force.norm(), 1e-3 * needs.weight) << kind;
      EXPECT_LT(need.moment.norm(), 1e-3 * needs.weight) << kind;
    }
    EXPECT_TRUE(infeasible_stretches(needs).empty()) << kind;
  }
}

TEST(PoseNeeds, OnAPlateAreAsOnTheFloor) {
  const motion::Clip clip = exact("lunge"), high = test::raised(clip);
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(high);
  const PoseNeeds low_needs = needs_of(clip),
                  high_needs = needs_of_poses(character, poses, clip.fps, {}, high.scene),
                  hovering = needs_of_poses(character, poses, clip.fps);
  for (int t = 0; t < clip.frames(); ++t) {
    EXPECT_NEAR((high_needs.frames[t].force - low_needs.frames[t].force).norm(), 0.0, 1e-3) << t;
    EXPECT_NEAR(high_needs.frames[t].lowest, low_needs.frames[t].lowest, 1e-9);
  }
  EXPECT_GT(hovering.frames[10].force.norm(), 0.5 * hovering.weight);
  const Slip low_slip = slip_of_poses(character, motion::poses_of(clip), clip.fps, {}, kGravity),
             high_slip = slip_of_poses(character, poses, clip.fps, high.scene, kGravity);
  EXPECT_EQ(high_slip.loaded, low_slip.loaded);
  EXPECT_NEAR(high_slip.mean, low_slip.mean, 1e-3);
}

TEST(PoseNeeds, LiftedMotionNeedsItsWeightWhereItStands) {
  const motion::Clip clip = exact("stand");
  const Character c = motion::character_of(clip);
  const PoseNeeds needs =
      needs_of_poses(c, moved(motion::poses_of(clip), Quaterniond::Identity(), {0.0, 0.0, 0.1}), clip.fps);
  for (const PoseNeed& need : needs.frames) {
    EXPECT_EQ(need.points, 0);
    EXPECT_NEAR(need.force.z(), needs.weight, 0.05 * needs.weight);
    EXPECT_EQ(wrong_with(need, needs.weight), Wrong::kHovers);
  }
  double mean = 0.0;
  for (const PoseNeed& need : needs.frames) mean += need.force.z() / needs.frames.count();
  EXPECT_NEAR(mean, needs.weight, 0.01 * needs.weight);
  const PoseVerdict verdict = verdict_on(needs);
  EXPECT_EQ(value_of(verdict.values, "hovers_share"), 1.0);
  EXPECT_EQ(verdict.longest.frames(), needs.frames.count());
  EXPECT_NE(verdict.words.find("the body hovers"), std::string::npos) << verdict.words;
}

TEST(PoseNeeds, LeaningMotionTipsOver) {
  const motion::Clip clip = exact("stand");
  const Character c = motion::character_of(clip);
  PerFrame<BodyPoses> poses =
      moved(motion::poses_of(clip), exp_map(20.0 * kDegree * Vector3d::UnitX()), Vector3d::Zero());
  poses = moved(poses, Quaterniond::Identity(), {0.0, 0.0, -lowest(c, poses)});
  const PoseNeeds needs = needs_of_poses(c, poses, clip.fps);
  const PoseVerdict verdict = verdict_on(needs);
  EXPECT_EQ(value_of(verdict.values, "tips_share"), 1.0);
  EXPECT_NE(verdict.words.find("the body tips over"), std::string::npos) << verdict.words;
  EXPECT_GT(value_of(verdict.values, "moment_mean_Nm"), 0.1 * needs.weight);
}

TEST(PoseNeeds, MotionInTheFloorIsSunk) {
  const motion::Clip clip = exact("squat");
  const PoseNeeds needs =
      needs_of_poses(motion::character_of(clip),
                     moved(motion::poses_of(clip), Quaterniond::Identity(), {0.0, 0.0, -0.2}), clip.fps);
  const PoseVerdict verdict = verdict_on(needs);
  EXPECT_EQ(value_of(verdict.values, "sunk_share"), 1.0);
  EXPECT_NE(verdict.words.find("mm in the floor"), std::string::npos) << verdict.words;
  EXPECT_NEAR(verdict.longest.depth, 0.2, 0.01);
}

TEST(PoseNeeds, LegInTheSideOfABoxIsSunk) {
  motion::Clip clip = exact("stand");
  const Character character = motion::character_of(clip);
  const PerFrame<BodyPoses> poses = motion::poses_of(clip);
  const Vector3d knee = poses[0].p_WB[kLeftKnee];
  const auto words_beside = [&](double gap) {  // of the side of a box, from the left knee's centre
    clip.scene.plates = {
        {.centre = {knee.x() + gap + 1.0, knee.y()}, .half_extents = {1.0, 1.0}, .height = 0.6}};
    return verdict_on(needs_of_poses(character, poses, clip.fps, {}, clip.scene)).words;
  };
  EXPECT_EQ(words_beside(0.3).find("mm in"), std::string::npos) << words_beside(0.3);
  const std::string words = words_beside(-0.1);
  EXPECT_NE(words.find("mm in a box; 100 % of the frames are infeasible"), std::string::npos) << words;
}

/// A rigid pose that falls from rest, and one that falls half again as fast.
TEST(PoseNeeds, FlightNeedsNothingAndAFasterFallIsPulled) {
  const motion::Clip clip = motion::standing_clip(1);
  const Character c = motion::character_of(clip);
  const auto falling = [&](double gravity) {
    PerFrame<BodyPoses> poses;
    for (int t = 0; t < 20; ++t)
      poses.push_back(moved(motion::poses_of(clip), Quaterniond::Identity(),
                            {0.05 * t, 0.0, 3.0 - 0.5 * gravity * t * t / 900.0})[0]);
    return needs_of_poses(c, poses, 30.0);
  };
  for (const PoseNeed& need : falling(kGravity).frames) {
    EXPECT_LT(need.force.norm(), 1e-6);
    EXPECT_LT(need.moment.norm(), 1e-6);
  }
  const PoseNeeds fast = falling(1.5 * kGravity);
  for (const PoseNeed& need : fast.frames) {
    EXPECT_NEAR(need.force.z(), -0.5 * fast.weight, 1e-6);
    EXPECT_EQ(wrong_with(need, fast.weight), Wrong::kPulled);
  }
}

/// A standing pose that accelerates sideways at 1.6 g: the floor's friction carries it as far as its cone.
TEST(PoseNeeds, AccelerationBeyondFrictionSlips) {
  const motion::Clip clip = motion::standing_clip(1);
  const Character c = motion::character_of(clip);
  const PerFrame<BodyPoses> still = motion::poses_of(clip);
  PerFrame<BodyPoses> lying;  // on its back: long levers, so that nothing tips
  const Quaterniond back = exp_map(-90.0 * kDegree * Vector3d::UnitX());
  const double height = -lowest(c, moved(still, back, Vector3d::Zero()));
  for (int t = 0; t < 12; ++t)
    lying.push_back(moved(still, back, {0.0, 0.5 * 1.6 * kGravity * t * t / 900.0, height})[0]);
  const PoseNeeds needs = needs_of_poses(c, lying, 30.0, {.reach = 0.1});
  for (const PoseNeed& need : needs.frames) {
    EXPECT_EQ(wrong_with(need, needs.weight), Wrong::kSlips);
    EXPECT_LT(need.force.norm(), 0.7 * needs.weight);
  }
}

/// Without smoothing the needs of the frames are those of the audit that looks at exact motions.
TEST(PoseNeeds, AgreesWithTheUnsmoothedDemandsWhereNothingTouches) {
  motion::Clip clip = exact("punch");
  for (Vector3d& p : clip.trans) p.z() += 0.5;
  const PoseNeeds needs = needs_of(clip, {.window = 0.0});
  const std::vector<FrameDemand> demands = motion_demands(clip);
  for (int t = 1; t + 1 < needs.frames.count(); ++t) {
    const FrameDemand& demand = demands[static_cast<std::size_t>(t - 1)];
    EXPECT_LT((needs.frames[t].force - demand.residual_force).norm(), 1e-9);
    EXPECT_LT((needs.frames[t].moment - demand.residual_moment).norm(), 1e-9);
  }
}

/// Other equations: the recursive Newton-Euler algorithm at velocities and accelerations of a smooth motion.
TEST(BodyLoads, AgreeWithInverseDynamicsOnASmoothMotion) {
  const motion::Clip clip = motion::standing_clip(1);
  const Character c = motion::character_of(clip);
  const double fps = 2000.0;
  const auto swing = [](int b) {
    return Vector3d(0.3 * std::sin(1.0 + b), 0.2 * std::cos(2.0 * b), 0.1 * b / kBodies);
  };
  // q(s) = q0 exp(s² swing / 2): at s = 0 at rest, accelerating by `swing`; hinges about their axes.
  const auto turn_of = [&](int b) -> Vector3d {
    return is_hinge(b) ? Vector3d(swing(b).x() * hinge_axis(b)) : swing(b);
  };
  physics::MotionState state;
  const auto q0 = motion::joint_rotations(clip)[0];
  const Vector3d p0(0.1, 0.2, 1.5), a0(0.5, -1.0, 2.0);
  PerFrame<BodyPoses> poses;
  for (const double s : {-1.0 / fps, 0.0, 1.0 / fps}) {
    PerBody<Quaterniond> q;
    for (int b = 0; b < kBodies; ++b) q[b] = q0[b] * exp_map(0.5 * s * s * turn_of(b));
    poses.push_back(forward_kinematics(c, p0 + 0.5 * s * s * a0, q));
  }
  state.p_root = p0;
  state.v_root.setZero();
  state.a_root = a0;
  state.q = q0;
  state.omega.fill(Vector3d::Zero());
  for (int b = 0; b < kBodies; ++b) state.omega_d[b] = turn_of(b);
  physics::BodyWrenches none;
  none.fill(Vector6d::Zero());
  const physics::RequiredForces required = physics::inverse_dynamics(c, kGravity, state, none);
  const PerBody<BodyLoad> loads = body_loads(c, poses, 1, fps);
  EXPECT_LT((wrench_of(loads, p0) - required.root).norm(), 1e-3 * required.root.norm());
  const PerBody<Vector3d> moments = joint_moments(loads, poses[1]);
  for (int b = 1; b < kBodies; ++b) {
    const Vector3d armature = c.joint[b].armature * state.omega_d[b];
    Vector3d expected = required.joint[b] - armature, found = poses[1].q_WB[b].conjugate() * moments[b];
    if (is_hinge(b)) found = found.dot(hinge_axis(b)) * hinge_axis(b);
    EXPECT_LT((found - expected).norm(), 1e-3 * (1.0 + expected.norm())) << kBodyNames[b];
  }
}

/// A character that the simulator drops and shakes: its poses alone need little, and the floor found for them
/// is the recorded one, averaged as the needs are. What poses cannot tell is when a force acted between two
/// frames.
TEST(PoseNeeds, SimulatedMotionNeedsLittleAndFindsTheRecordedFloorForce) {
  for (const double size : {0.0, 0.08}) {
    const Thrown thrown(240.0, size);
    const SimulatedFrames frames = thrown.frames();
    PerFrame<BodyPoses> poses;
    for (const motion::ReferenceFrame& frame : frames.frames)
      poses.push_back(forward_kinematics(frames.character, frame.p_root, frame.q));
    const PoseNeeds needs = needs_of_poses(frames.character, poses, frames.fps);
    PerFrame<double> recorded;  // of the interval that ends at a frame
    for (const auto& forces : frames.forces) {
      recorded.push_back(0.0);
      for (const Vector6d& wrench : forces.ground) recorded.back() += wrench[5];
    }
    double need = 0.0, gap = 0.0;
    int count = 0;
    for (int t = 3; t + 4 < needs.frames.count(); ++t, ++count) {
      const double weights[] = {12, 10, 5};
      double floor = 0.0;
      for (int j = -2; j <= 2; ++j)
        floor += weights[std::abs(j)] / 42.0 * 0.5 * (recorded[t + j] + recorded[t + j + 1]);
      need += needs.frames[t].force.norm();
      gap += std::abs(needs.frames[t].floor - floor);
    }
    std::printf("  measured: targets off by %.2f rad: need %.2f %%, floor apart by %.2f %% of the weight\n",
                size, 100.0 * need / count / needs.weight, 100.0 * gap / count / needs.weight);
    EXPECT_LT(need / count, 0.001 * needs.weight) << size;
    EXPECT_LT(gap / count, 0.02 * needs.weight) << size;
  }
}

/// Trembling of 1 mm, white, moves the needs of a standing motion by little; raw second differences by a lot.
TEST(PoseNeeds, SmoothingRemovesJitter) {
  motion::Clip clip = exact("stand");
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += 0.001 * ((t * 7919) % 13 - 6) / 6.0;
  const auto largest = [&](double window) {
    double force = 0.0;
    for (const PoseNeed& need : needs_of(clip, {.window = window, .friction = 0.0}).frames)
      force = std::max(force, need.force.head<2>().norm());
    return force;
  };
  EXPECT_LT(6.0 * largest(0.1), largest(0.0));
}

TEST(PoseNeeds, RejectsFewerThanThreeFrames) {
  const Character c = make_character();
  const PerFrame<BodyPoses> poses = motion::poses_of(motion::standing_clip(5));
  EXPECT_THROW(needs_of_poses(c, motion::poses_of(motion::standing_clip(2)), 30.0), std::invalid_argument);
  EXPECT_THROW(needs_of_poses(c, poses, 0.0), std::invalid_argument);
  EXPECT_THROW(needs_of_poses(c, poses, 30.0, {.window = -1.0}), std::invalid_argument);
  EXPECT_THROW(needs_of_poses(c, poses, 30.0, {.friction = -1.0}), std::invalid_argument);
}

// The floor of a foreign motion is not known, even if the joints of its body are.
TEST(PoseFiles, SimulatedMotionOfKnownJointsKeepsItsHeight) {
  const TemporaryFolder folder;
  const std::string path = (folder.path / "a.npz").string();
  const auto shift_of = [&](double lift, bool simulated) {
    motion::Clip clip = test::on_uneven_joints(motion::standing_clip(10));
    for (Vector3d& trans : clip.trans) trans.z() += lift;
    if (simulated) clip.passthrough.emplace_back("ground_wrenches", NpyArray::scalar(0.0));
    motion::write_clip(path, clip);
    const PoseFile file = audit_pose_file(path, {});
    EXPECT_EQ(file.failure, "");
    return file.floor_shift;
  };
  EXPECT_EQ(shift_of(0.3, true), 0.0);
  EXPECT_NEAR(shift_of(0.3, false), shift_of(0.0, false) - 0.3, 1e-9);
}

// The jump of `JumpAtAThirdOfTheSpeedIsFeasibleUnderANinthOfGravity`, and a walk, which needs friction.
TEST(PoseFiles, SimulatedMotionIsJudgedWithItsOwnGravityAndFriction) {
  const TemporaryFolder folder;
  const std::string path = (folder.path / "a.npz").string();
  const auto infeasible_share = [&](motion::Clip clip, const physics::SimulationConfig& simulation) {
    clip.passthrough = files::simulation_members(simulation, motion::character_of(clip).total_mass());
    motion::write_clip(path, clip);
    const PoseFile file = audit_pose_file(path, {});
    EXPECT_EQ(file.failure, "");
    return value_of(file.verdict.values, "infeasible_share");
  };
  motion::Clip slow = exact("jump");
  slow.fps /= 3.0;
  physics::SimulationConfig light, smooth;
  light.gravity = kGravity / 9.0;
  smooth.friction = 0.0;
  EXPECT_GT(infeasible_share(slow, {}), 0.0);
  EXPECT_EQ(infeasible_share(slow, light), 0.0);
  EXPECT_EQ(infeasible_share(exact("walk"), {}), 0.0);
  EXPECT_GT(infeasible_share(exact("walk"), smooth), 0.0);
}

TEST(PoseFiles, SlipIsThatOfEvaluate) {
  const TemporaryFolder folder;
  const std::string path = (folder.path / "a.npz").string();
  motion::Clip clip = motion::resampled(exact("walk"), 120.0);
  for (int t = 0; t < clip.frames(); ++t) clip.trans[t].x() += 0.002 * ((t * 7919) % 13 - 6) / 6.0;
  for (const char* model : {"mimicx", "smplx"}) {
    clip.body_model = model;
    motion::write_clip(path, clip);
    motion::Metrics metrics;
    const Slip evaluated = judge::judge_clip(import::read_motion(path), metrics),
               audited = audit_pose_file(path, {}).slip;
    EXPECT_GT(evaluated.loaded, 0) << model;
    EXPECT_EQ(audited.mean, evaluated.mean) << model;
    EXPECT_EQ(audited.share, evaluated.share) << model;
  }
}

TEST(PoseVerdict, StretchesAreNamedAfterTheMostFrequentFault) {
  PoseNeeds needs;
  needs.mass = 100.0;
  needs.weight = 981.0;
  needs.frames.resize(10);
  for (const int t : {2, 3, 4}) needs.frames[t].force.z() = 100.0 * t;
  needs.frames[4].force = Vector3d(60.0, 0.0, 0.0);
  needs.frames[8].moment.x() = 70.0;
  needs.frames[8].points = 3;
  needs.frames[8].torque[kLeftKnee] = 1.5;
  const std::vector<Stretch> stretches = infeasible_stretches(needs);
  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_EQ(in_words(stretches[0]), "frames 2-4: the body hovers; 300 N would have to hold it");
  EXPECT_EQ(in_words(stretches[1]), "frame 8: the body tips over; 70 N m would have to hold it");
  const PoseVerdict verdict = verdict_on(needs);
  EXPECT_EQ(verdict.joints_over, "left_knee:1");
  EXPECT_EQ(verdict.over_in_words, "left knee 1");
  EXPECT_NEAR(value_of(verdict.values, "infeasible_share"), 0.4, 1e-12);
  EXPECT_NEAR(value_of(verdict.values, "hovers_share"), 0.2, 1e-12);
  EXPECT_NEAR(value_of(verdict.values, "drifts_share"), 0.1, 1e-12);
  EXPECT_NEAR(value_of(verdict.values, "tips_share"), 0.1, 1e-12);
  EXPECT_EQ(value_of(verdict.values, "worst_frame"), 3.0);
  EXPECT_NEAR(value_of(verdict.values, "accel_max_m_s2"), 3.0, 1e-12);
  EXPECT_NEAR(value_of(verdict.values, "longest_s"), 0.1, 1e-12);
}

}  // namespace
}  // namespace mimicx::audit
