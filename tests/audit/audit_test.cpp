#include "audit/audit.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <sstream>

#include "audit/audit_file.h"
#include "audit/audit_summary.h"
#include "audit/thrown.h"
#include "core/temporary_folder.h"
#include "files/archive_members.h"
#include "files/inputs.h"
#include "files/motion_output.h"
#include "files/recorded_forces.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "motion/uneven_joints.h"
#include "program/configurations.h"
#include "run/preparation.h"

namespace mimicx::audit {
namespace {

double value(const Audit& audit, const std::string& name) {
  for (const auto& [key, v] : summary_of(audit))
    if (key == name) return v;
  ADD_FAILURE() << "no value " << name;
  return 0.0;
}

bool fails_with(const Audit& audit, const std::string& words) {
  for (const std::string& failure : audit.failures)
    if (failure.find(words) != std::string::npos) return true;
  return false;
}

std::string all_failures(const Audit& audit) {
  std::string text;
  for (const std::string& failure : audit.failures) text += failure + "\n";
  return text;
}

bool same(const motion::ReferenceFrame& a, const motion::ReferenceFrame& b) {
  bool equal = a.p_root == b.p_root && a.v_root == b.v_root;
  for (std::size_t i = 0; i < kBodies; ++i)
    equal = equal && a.q[i].coeffs() == b.q[i].coeffs() && a.omega[i] == b.omega[i];
  return equal;
}

TEST(Substeps, RoundTripIsExact) {
  const SubstepMotion motion = Thrown().steps(), back = written_and_read(motion);
  ASSERT_EQ(back.steps.size(), 59U * 8U);
  EXPECT_EQ(back.character.betas, motion.character.betas);
  EXPECT_EQ(back.simulation.rate, 240.0);
  EXPECT_TRUE(same(back.last, motion.last));
  for (std::size_t k = 0; k < motion.steps.size(); ++k) {
    const rl::tracking::Substep &a = motion.steps[k], &b = back.steps[k];
    EXPECT_TRUE(same(a.state, b.state)) << k;
    EXPECT_EQ(a.forces.ground, b.forces.ground) << k;
    EXPECT_EQ(a.forces.self_contact, b.forces.self_contact) << k;
    EXPECT_EQ(a.target_omega, b.target_omega) << k;
  }
}

// The first state and the targets alone give back every recorded state, bit by bit, in float32.
TEST(Substeps, FileReplaysToTheSameBits) {
  using P = rl::tracking::TrackingPack::P;
  const SubstepMotion motion = written_and_read(Thrown().steps());
  const physics::Model<float> model = physics::make_model<float>(motion.character, motion.simulation);
  const auto state = std::make_unique<physics::State<P>>();
  const auto target = std::make_unique<physics::Target<P>>();
  const auto data = std::make_unique<physics::Data<P>>();
  const auto vec = [](const Vector3d& v) { return physics::Vec3<P>{P(v.x()), P(v.y()), P(v.z())}; };
  const auto quat = [](const Quaterniond& q) {
    return physics::Quat<P>{P(q.w()), P(q.x()), P(q.y()), P(q.z())};
  };
  const motion::ReferenceFrame& start = motion.steps.front().state;
  state->p_root = vec(start.p_root);
  state->v_root = vec(start.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    state->q[i] = quat(start.q[i]);
    state->omega[i] = vec(start.omega[i]);
  }
  for (std::size_t k = 0; k < motion.steps.size(); ++k) {
    for (std::size_t i = 0; i < kBodies; ++i) {
      target->q[i] = quat(motion.steps[k].target_q[i]);
      target->omega[i] = vec(motion.steps[k].target_omega[i]);
    }
    physics::step(model, *target, *state, *data);
    const motion::ReferenceFrame& next =
        k + 1 < motion.steps.size() ? motion.steps[k + 1].state : motion.last;
    for (std::size_t i = 0; i < kBodies; ++i) {
      ASSERT_EQ(static_cast<double>(state->q[i].w[0]), next.q[i].w()) << "step " << k << " body " << i;
      ASSERT_EQ(static_cast<double>(state->omega[i].x[0]), next.omega[i].x()) << "step " << k;
    }
    ASSERT_EQ(static_cast<double>(state->p_root.z[0]), next.p_root.z()) << "step " << k;
  }
}

TEST(Substeps, RecordingDoesNotChangeTheRollout) {
  const Thrown thrown;
  const auto clip = rl::tracking::make_tracking_clip(thrown.reference, thrown.config);
  const auto still = [](int, const float*, float* action) { std::fill(action, action + kDofs, 0.1F); };
  const auto with = rl::tracking::roll_out(clip, thrown.config, still, true),
             without = rl::tracking::roll_out(clip, thrown.config, still, false);
  EXPECT_TRUE(without.substeps.empty());
  ASSERT_EQ(with.poses.size(), without.poses.size());
  for (std::size_t t = 0; t < with.poses.size(); ++t) {
    EXPECT_TRUE(same(with.poses[t].frame, without.poses[t].frame));
    EXPECT_EQ(with.forces[t].ground, without.forces[t].ground);
    EXPECT_EQ(with.forces[t].joint_torque, without.forces[t].joint_torque);
  }
}

TEST(Substeps, KnownJointsAreReadBack) {
  const RestJoints joints = test::uneven_joints();
  SubstepMotion motion = Thrown().steps();
  motion.steps.resize(2);
  motion.character = make_character_of_joints(joints);
  motion.rest_joints = joints;
  const SubstepMotion back = written_and_read(motion);
  EXPECT_EQ(back.rest_joints, joints);
  EXPECT_EQ(back.character.joint_offset, motion.character.joint_offset);
  EXPECT_EQ(back.character.mass, motion.character.mass);
  EXPECT_NE(make_character(motion.character.betas).joint_offset, motion.character.joint_offset)
      << "betas alone make another body";
}

TEST(Substeps, DamagedFileIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path / "s.npz";
  write_substeps(path, Thrown().steps());
  Npz npz = read_npz(path);
  npz.set("ground_wrenches", NpyArray::scalar(1.0));
  write_npz(path, npz);
  try {
    audit_file(path, false);
    FAIL() << "must be refused";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("s.npz: ground_wrenches"), std::string::npos) << error.what();
  }
}

TEST(Substeps, RejectsImpossibleBodiesAndSimulations) {
  const TemporaryFolder folder;
  SubstepMotion motion = Thrown().steps();
  motion.steps.resize(2);
  write_substeps(folder.path / "s.npz", motion);
  const Npz sound = read_npz(folder.path / "s.npz");
  for (const auto& [name, array] : std::vector<std::pair<std::string, NpyArray>>{
           {"betas", from_matrix(Eigen::MatrixXd::Constant(kBetas, 1, 7.0))},
           {"ground_damping", from_matrix(Eigen::MatrixXd::Constant(1, 1, -1.0))}}) {
    Npz damaged = sound;
    damaged.set(name, array);
    EXPECT_THROW(read_substeps(damaged), DataError) << name;
  }
  EXPECT_NO_THROW(read_substeps(sound));
}

TEST(Audit, ViolentStepsAreExplainedToRoundingInDouble) {
  const SubstepMotion motion = written_and_read(Thrown(240.0, 0.3).steps());
  const Audit recorded = audit_steps(motion), replayed = audit_replayed_steps(motion);
  double hardest = 0.0;
  for (const AuditRow& row : recorded.rows) hardest = std::max(hardest, row.normal);
  EXPECT_GT(hardest, 3.0 * recorded.weight) << "no impact";
  EXPECT_EQ(all_failures(recorded), "");
  EXPECT_EQ(all_failures(replayed), "");
  EXPECT_LT(value(recorded, "root_force_mean_N"), 0.2);
  EXPECT_LT(value(recorded, "root_force_max_N"), 15.0);
  EXPECT_LT(value(recorded, "torque_gap_max_Nm"), 10.0);
  EXPECT_LT(value(replayed, "root_force_max_N"), 1e-7);
  EXPECT_LT(value(replayed, "root_moment_max_Nm"), 1e-7);
  EXPECT_LT(value(replayed, "torque_gap_max_Nm"), 1e-7);
  EXPECT_LT(value(replayed, "replay_gap_mean_N"), 0.2);
  EXPECT_EQ(value(recorded, "torque_violations"), 0.0);
}

TEST(Audit, FramesOfRandomActionsAreExplained) {
  for (const double size : {0.0, 0.08, 0.15}) {
    const Audit audit = Thrown(240.0, size).audit();
    EXPECT_EQ(all_failures(audit), "") << size;
    std::printf("  measured: targets off by %.2f rad: %.2f N mean, %.1f N most\n", size,
                value(audit, "root_force_mean_N"), value(audit, "root_force_max_N"));
    EXPECT_EQ(audit.rows.size(), 59U);
  }
}

// (10) leaves out what the integrator itself does to momentum between two frames: of first order in dt.
TEST(Audit, FrameResidualIsFirstOrderInThePhysicsStep) {
  std::array<double, 3> force{}, moment{};
  for (std::size_t k = 0; k < force.size(); ++k) {
    Thrown thrown(240.0 * static_cast<double>(1 << (2 * k)), 0.0);
    for (auto& f : thrown.reference.frames) f.p_root.z() += 5.0;  // in the air: the same motion at every rate
    const auto clip = rl::tracking::make_tracking_clip(thrown.reference, thrown.config);
    thrown.rollout = rl::tracking::roll_out(clip, thrown.config, [](int, const float*, float* action) {
      for (int n = 0; n < kDofs; ++n) action[n] = 0.5F * static_cast<float>(n % 3 - 1);
    });
    thrown.rollout.poses.resize(10);  // later the joints rest at their targets: only rounding is left
    const Audit audit = thrown.audit();
    force[k] = value(audit, "root_force_mean_N");
    moment[k] = value(audit, "root_moment_mean_Nm");
  }
  for (std::size_t k = 1; k < force.size(); ++k) {
    EXPECT_NEAR(force[k - 1] / force[k], 4.0, 1.2) << k;
    EXPECT_NEAR(moment[k - 1] / moment[k], 4.0, 1.2) << k;
  }
}

TEST(Audit, OfOneFrameFails) {
  const SimulatedFrames one{make_character(), 30.0, {{}}, {{}}, {}};
  const Audit audit = audit_frames(one, {});
  ASSERT_EQ(audit.failures.size(), 1u);
  EXPECT_NE(audit.failures[0].find("no two frames"), std::string::npos);
}

TEST(Audit, DetectsAnExternalForceAndItsSize) {
  Thrown thrown(240.0, 0.0);
  for (auto& forces : thrown.rollout.forces)
    for (Vector6d& wrench : forces.ground) wrench *= 0.9;  // a tenth of the support is not accounted for
  const Audit audit = thrown.audit();
  EXPECT_TRUE(fails_with(audit, "mean unexplained root force")) << all_failures(audit);
  double support = 0.0;
  for (const AuditRow& row : audit.rows) support += row.normal / 0.9 / static_cast<double>(audit.rows.size());
  EXPECT_NEAR(value(audit, "root_force_mean_N"), 0.1 * support, 0.03 * support);
}

TEST(Audit, NamesEveryKindOfFalsifiedForce) {
  const Thrown good;
  EXPECT_EQ(all_failures(good.audit()), "");
  Thrown lie = good;
  for (auto& forces : lie.rollout.forces) forces.joint_torque[kLeftHip] *= 20.0;
  EXPECT_TRUE(fails_with(lie.audit(), "of its bound"));
  lie = good;  // within its bound, and without effect on the root: only the joint itself tells
  for (auto& forces : lie.rollout.forces) forces.joint_torque[kLeftKnee].setZero();
  EXPECT_TRUE(fails_with(lie.audit(), "mean gap between required and exported torques"));
  lie = good;
  for (auto& forces : lie.rollout.forces)
    for (Vector6d& wrench : forces.ground) wrench[3] += 2.0 * std::abs(wrench[5]);
  EXPECT_TRUE(fails_with(lie.audit(), "friction beyond its cone"));
  lie = good;
  for (auto& forces : lie.rollout.forces) forces.ground[kHead][5] -= 100.0;
  EXPECT_TRUE(fails_with(lie.audit(), "pull of the floor"));
  lie = good;
  for (std::size_t t = 0; t < 15; ++t) lie.rollout.forces[t].ground[kHead][5] += 400.0;
  EXPECT_TRUE(fails_with(lie.audit(), "on bodies in the air"));
  lie = good;
  for (auto& pose : lie.rollout.poses) pose.frame.v_root.x() += 2.0;
  EXPECT_TRUE(fails_with(lie.audit(), "do not fit the positions"));
}

// Recorded steps know what no frame can: torques of a hard motion that are off by a few percent do not pass.
TEST(Audit, DetectsTorqueErrorsOfAFewPercent) {
  SubstepMotion motion = Thrown().steps();
  EXPECT_EQ(all_failures(audit_steps(motion)), "");
  for (rl::tracking::Substep& step : motion.steps)
    for (Vector3d& torque : step.forces.joint_torque) torque *= 1.03;
  EXPECT_TRUE(fails_with(audit_steps(motion), "mean gap between required and exported torques"));
}

TEST(Audit, WorkIsTorqueTimesTheAngleTurned) {
  // By hand: one joint, torque 3 N·m about x, turning 0.1 rad about x per frame, does 0.3 J per frame.
  SimulatedFrames motion;
  motion.character = make_character();
  for (int t = 0; t < 11; ++t) {
    motion::ReferenceFrame f;
    f.p_root = f.v_root = Vector3d::Zero();
    f.q.fill(Quaterniond::Identity());
    f.omega.fill(Vector3d::Zero());
    f.q[kSpine1] = exp_map(Vector3d(0.1 * t, 0, 0));
    motion.frames.push_back(f);
    rl::tracking::ActingForces forces;
    forces.joint_torque.fill(Vector3d::Zero());
    forces.range_torque.fill(Vector3d::Zero());
    forces.ground.fill(Vector6d::Zero());
    forces.self_contact.fill(Vector6d::Zero());
    forces.joint_torque[kSpine1] = {3.0, 1.0, 0.0};
    forces.joint_torque[kLeftKnee] = {5.0, 0.0, 0.0};  // holds still: no work
    motion.forces.push_back(forces);
  }
  const Audit audit = audit_frames(motion, {});
  EXPECT_NEAR(value(audit, "work_positive_J"), 3.0, 1e-9);
  EXPECT_NEAR(value(audit, "work_negative_J"), 0.0, 1e-9);
  EXPECT_NEAR(value(audit, "power_max_W"), 9.0, 1e-9);
}

struct CleanedAndRaw : testing::Test {
  static std::filesystem::path split(const std::string& kind, const std::string& name) {
    return std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "synthetic" / "test" / kind / (name + ".npz");
  }
};

// The contrast of docs/physics.md §9, on motions that the shipped options follow without any training.
TEST_F(CleanedAndRaw, CleanedMotionPassesAndItsNoisyInputFails) {
  const TemporaryFolder folder;
  program::AdaptConfig config = program::adapt_configuration();
  config.method = program::AdaptMethod::kOptions;
  run::RunConfig& run = config.run;
  for (const char* name : {"squat_1", "wave_1"}) run.inputs.push_back(split("noisy", name).string());
  run.out = folder.path / "run";
  run.correction.fit = run.substeps = true;
  config.training.samples = 0;
  config.options = {
      pipeline::options::read_options(std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "options")};
  std::ostringstream messages;
  record::Progress progress(messages, false, record::steady_seconds);
  program::adapt(config, {progress, messages, [] { return false; }});
  for (const record::SequenceEntry& entry : record::read_manifest(run.out / "manifest.json").sequences) {
    ASSERT_TRUE(entry.ok) << entry.name;
    const Audit clean = audit_file(run.out / entry.output, false).at(0);
    EXPECT_EQ(clean.evidence, Evidence::kFrames);
    EXPECT_EQ(all_failures(clean), "") << entry.name;
    EXPECT_LT(value(clean, "root_force_mean_N"), 0.002 * clean.weight);
    EXPECT_EQ(value(clean, "torque_violations"), 0.0);
    for (const auto& [name, recorded] :
         entry.audit)  // the manifest says the same of it before it was rounded to a file
      EXPECT_NEAR(recorded, value(clean, name), 1e-5 + 1e-5 * std::abs(recorded)) << name;
    for (const Audit& steps : audit_file(run.out / "substeps" / (entry.name + ".npz"), false))
      EXPECT_EQ(all_failures(steps), "") << entry.name;
    // Judged alike, by poses alone under the best floor there could be:
    EXPECT_EQ(all_failures(audit_file(run.out / entry.output, true).at(0)), "") << entry.name;
    const Audit raw = audit_file(entry.input, false).at(0);
    EXPECT_EQ(raw.evidence, Evidence::kPosesAlone);
    EXPECT_TRUE(fails_with(raw, "mean unexplained root force")) << entry.name;
    EXPECT_GT(value(raw, "root_force_mean_N"), 100.0 * value(clean, "root_force_mean_N"));
  }
}

TEST_F(CleanedAndRaw, NoisyTestMotionsFailAndTruthsPass) {
  for (const std::string& path :
       files::paths_of(files::find_motions({split("noisy", "x").parent_path().string()}))) {
    const Audit raw = audit_file(path, false).at(0);
    EXPECT_TRUE(fails_with(raw, "mean unexplained root force")) << path;
    EXPECT_TRUE(fails_with(raw, "of the frames; lowest point")) << path;
  }
  for (const std::string& path :
       files::paths_of(files::find_motions({split("truth", "x").parent_path().string()})))
    EXPECT_EQ(all_failures(audit_file(path, false).at(0)), "") << path;
}

TEST_F(CleanedAndRaw, JointsOfTheFileAreThoseOfTheBodyThatIsJudged) {
  const TemporaryFolder folder;
  motion::Clip clip = motion::standing_clip(40);
  const Character standard = motion::character_of(clip);
  RestJoints joints{};
  for (int i = 0; i < kBodies; ++i)
    joints[i] = 1.15 * standard.joint_offset[i] + (i == 0 ? Vector3d::Zero() : joints[kParents[i]]);
  motion::Clip large = clip;
  large.rest_joints = joints;
  const Vector3d lift(0.0, 0.0, 0.15 * motion::poses_of(clip)[0].p_WB[0].z());
  for (Vector3d& trans : large.trans) trans += lift + motion::rest_pelvis(clip) - motion::rest_pelvis(large);
  motion::write_clip(folder.path / "large.npz", large);
  const Audit by_motion = audit_file(folder.path / "large.npz", false).at(0);
  EXPECT_NEAR(by_motion.weight, 9.81 * motion::character_of(large).total_mass(), 0.5);
  EXPECT_EQ(all_failures(by_motion), "");
}

// As `adapt --smplx --substeps` leaves them.
TEST(Audit, FilesOfABodyOfKnownJointsAreJudgedWithItsBones) {
  const motion::Clip input = test::on_uneven_joints(motion::standing_clip(60));
  const Thrown thrown(240.0, 0.08, {}, motion::character_of(input));
  const TemporaryFolder folder;
  files::write_simulated(
      folder.path / "motion.npz", input, thrown.reference, thrown.rollout,
      files::simulation_members(thrown.config.simulation, thrown.reference.character.total_mass()));
  SubstepMotion steps = thrown.steps();
  steps.rest_joints = input.rest_joints;
  write_substeps(folder.path / "steps.npz", steps);
  const std::vector<Audit> frames = audit_file(folder.path / "motion.npz", false),
                           both = audit_file(folder.path / "steps.npz", false);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].evidence, Evidence::kFrames);
  EXPECT_EQ(all_failures(frames[0]), "");
  ASSERT_EQ(both.size(), 2u);
  for (const Audit& audit : both) EXPECT_EQ(all_failures(audit), "") << evidence_name(audit.evidence);
}

TEST_F(CleanedAndRaw, RejectsIncompleteForcesByName) {
  const TemporaryFolder folder;
  Npz npz = read_npz(split("truth", "stand_1"));
  const std::size_t rows = npz.at("poses").shape[0];
  npz.set("joint_torques", files::joints_member(files::VectorRows(rows), files::Precision::kFloat64));
  write_npz(folder.path / "half.npz", npz);
  try {
    audit_file(folder.path / "half.npz", false);
    FAIL() << "must be refused";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("velocities"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mimicx::audit
