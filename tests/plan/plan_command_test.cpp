// `mimicx plan`, end to end on motions of a second or two.
#include "plan/plan_command.h"

#include <gtest/gtest.h>

#include <numbers>

#include "audit/audit_file.h"
#include "core/npz/npz.h"
#include "core/setting_checks.h"
#include "core/temporary_folder.h"
#include "core/units.h"
#include "files/plan_file.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "program/small_run.h"
#include "record/feasibility_file.h"
#include "report/glossary.h"
#include "run/results.h"

namespace mimicx::plan {
namespace {

struct PlanMotions : testing::Test {
  void SetUp() override {
    motion::write_clip(stand, motion::standing_clip(20));
    motion::write_clip(other, motion::standing_clip(30));
    motion::write_clip(third, motion::standing_clip(35));
    motion::Clip leaning = motion::standing_clip(30);  // by 45° to the side, as nobody can stand
    for (auto& frame : leaning.rotations)
      frame[kPelvis] = log_map(exp_map(Vector3d(0.0, std::numbers::pi / 4, 0.0)) * exp_map(frame[kPelvis]));
    motion::write_clip(lean, leaning);
  }
  PlanMotionsConfig planning(const std::string& name, const std::vector<std::string>& inputs) const {
    PlanMotionsConfig config = plan_configuration();
    config.run.inputs = inputs;
    config.run.out = out(name);
    config.planning.plan.horizon.backtracks = 1;  // what is lost shall be so soon
    return config;
  }
  static program::Outcome run(const PlanMotionsConfig& config, int asked = -1) {
    return program::run_in_context(
        [&](const record::RunContext& context) { return plan_motions(config, context); }, asked);
  }
  record::SequenceEntry entry(const std::string& name, std::size_t k = 0) const {
    return record::read_manifest(out(name) / "manifest.json").sequences.at(k);
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
  std::string stand = out("stand.npz").string(), other = out("other.npz").string(),
              third = out("third.npz").string(), lean = out("lean.npz").string();
};

TEST_F(PlanMotions, LeavesEveryFileTheDocumentationNames) {
  EXPECT_EQ(run(planning("run", {stand})).value, record::RunOutcome::kAllGood);
  const auto files = run::results_of(out("run"));
  for (const char* name :
       {"manifest.json", "report.html", "motions/stand.npz", "inputs/stand.npz", "references/stand.npz",
        "plans/stand.npz", "feasibility/stand.npz", "clean/stand.npz"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_EQ(files.size(), 8u);
  EXPECT_FALSE(std::filesystem::exists(out("run") / "training"));
  const Npz motion = read_npz(out("run") / "motions" / "stand.npz");
  EXPECT_EQ(motion.at("joint_torques").shape, (std::vector<std::size_t>{20, 55}));
  EXPECT_EQ(motion.at("ground_wrenches").shape, (std::vector<std::size_t>{20, 22, 6}));
}

TEST_F(PlanMotions, SceneIsInEveryFileAndReplaysNeedNoOther) {
  motion::write_clip(out("raised.npz"), motion::standing_clip(20));
  PlanMotionsConfig config = planning("run", {out("raised.npz").string()});
  motion::Clip high = motion::standing_clip(20);
  for (Vector3d& trans : high.trans) trans.z() += 0.25;
  motion::write_clip(out("raised.npz"), high);
  config.run.read.scene = Scene{{{{0.0, 0.0}, 0.3, {0.5, 0.5}, 0.25}, {{2.0, 0.0}, 0.0, {0.5, 0.5}, 0.5}}};
  config.run.substeps = true;
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  for (const char* part : {"inputs", "references", "motions", "substeps"})
    EXPECT_EQ(motion::scene_of(read_npz(out("run") / part / "raised.npz")), *config.run.read.scene) << part;
  EXPECT_LT(value_of(entry("run").metrics, "gMPJPE"), 5.0);
  EXPECT_LT(value_of(entry("run").metrics, "GP_max"), 2.0);
  EXPECT_LT(value_of(entry("run").metrics, "Float"), 1.0);
  for (const char* part : {"motions", "substeps"})
    for (const audit::Audit& audit : audit::audit_file(out("run") / part / "raised.npz", false))
      EXPECT_TRUE(audit.failures.empty()) << part << ": " << audit.failures[0];
  const motion::Clip made = motion::read_clip(out("run") / "motions" / "raised.npz");
  EXPECT_GT(made.trans.back().z(), 1.0);  // it would fall from there without the plate
  config.run.read.scene->plates[0].height = 0.2;
  EXPECT_THROW(run(config), std::invalid_argument) << "another scene is another run";
}

TEST_F(PlanMotions, RecordsThePlanAndPassesTheAudit) {
  run(planning("run", {stand}));
  const record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  EXPECT_EQ(manifest.method, "plan");
  EXPECT_EQ(manifest.samples, 0);
  EXPECT_EQ(value_of(manifest.settings, "plan_horizon"), control::HorizonConfig{}.horizon);
  EXPECT_EQ(value_of(manifest.settings, "physics_rate"), physics::SimulationConfig{}.rate);
  const record::SequenceEntry& entry = manifest.sequences.at(0);
  EXPECT_TRUE(entry.ok) << entry.reason;
  EXPECT_EQ(entry.method, "plan");
  EXPECT_EQ(entry.ending, record::SequenceEnding::kFollowed);
  EXPECT_EQ(value_of(entry.plan, "frames"), 20);
  EXPECT_GT(value_of(entry.plan, "iterations"), 0);
  EXPECT_LT(value_of(entry.metrics, "gMPJPE"), 5.0);
  EXPECT_LT(value_of(entry.audit, "root_force_mean_N"), 0.05 * 9.81 * make_character().total_mass());
  for (const std::string& note : entry.notes) EXPECT_EQ(note.find("audit"), std::string::npos) << note;
}

TEST_F(PlanMotions, ReportShowsAMotionWithoutTraining) {
  run(planning("run", {stand}));
  const std::string page = read_file(out("run") / "report.html");
  EXPECT_NE(page.find("\"words\":\"distance from the prepared reference\""), std::string::npos);
  EXPECT_NE(page.find("\"name\":\"keypoints (Eq. 3)\""), std::string::npos) << "a factor of the reward";
  for (const char* who : {"input", "reference", "cleaned"})
    EXPECT_NE(page.find("\"who\":\"" + std::string(who) + "\",\"frames\":20,"), std::string::npos) << who;
  EXPECT_EQ(page.find("falls in training"), std::string::npos);
  EXPECT_EQ(page.find("cannot be shown"), std::string::npos);
}

TEST_F(PlanMotions, ReportHasWordsForEveryManifestNumber) {
  run(planning("run", {stand}));
  const record::SequenceEntry made = entry("run");
  for (const auto& [group, values] :
       {std::pair{"metrics", made.input_metrics}, std::pair{"metrics", made.metrics},
        std::pair{"plan", made.plan}, std::pair{"preparation", made.preparation},
        std::pair{"feasibility", made.feasibility}, std::pair{"audit", made.audit}})
    for (const auto& [name, value] : values)
      EXPECT_TRUE(report::has_words(group, name)) << group << ' ' << name;
}

TEST_F(PlanMotions, KeepsTheInputAndRemakesADamagedCopy) {
  run(planning("run", {stand}));
  const std::filesystem::path kept = out("run") / "inputs" / "stand.npz";
  const motion::Clip input = motion::read_clip(kept), given = motion::read_clip(stand);
  EXPECT_EQ(input.trans, given.trans);
  EXPECT_EQ(input.rotations, given.rotations);
  const std::string bytes = read_file(kept), page = read_file(out("run") / "report.html");
  std::filesystem::remove(kept);
  run(planning("run", {stand}));
  EXPECT_EQ(read_file(kept), bytes);
  EXPECT_EQ(read_file(out("run") / "report.html"), page);
}

TEST_F(PlanMotions, RewardIsTheProductOfItsFactors) {
  run(planning("run", {stand}));
  const Npz motion = read_npz(out("run") / "motions" / "stand.npz");
  const std::vector<double> rewards = motion.at("reward").to_double(),
                            factors = motion.at("reward_factors").to_double();
  ASSERT_EQ(factors.size(), 6 * rewards.size());
  for (std::size_t t = 0; t < rewards.size(); ++t) {
    double product = 1.0;
    for (std::size_t k = 0; k < 6; ++k) product *= factors[6 * t + k];
    EXPECT_NEAR(product, rewards[t], 1e-12) << t;
  }
}

TEST_F(PlanMotions, MotionRepeatsThePlanExactly) {
  run(planning("run", {stand}));
  const files::StoredPlan stored = files::read_plan(out("run") / "plans" / "stand.npz");
  const auto velocities = read_npz(out("run") / "motions" / "stand.npz").at("velocities").to_double();
  ASSERT_EQ(stored.plan.states.size(), 20u);
  for (std::size_t t = 1; t < 20; ++t) {
    const physics::State<double>& x = stored.plan.states[t];
    const double* row = velocities.data() + t * (6 + kDofs);
    EXPECT_EQ(physics::to_eigen(x.v_root), Vector3d(row[0], row[1], row[2])) << t;
    EXPECT_EQ(physics::to_eigen(x.omega[kPelvis]), Vector3d(row[3], row[4], row[5])) << t;
    EXPECT_EQ(physics::to_eigen(x.omega[1]), Vector3d(row[6], row[7], row[8])) << t;
  }
}

TEST_F(PlanMotions, IsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  PlanMotionsConfig config = planning("one", {other, third});
  run(config);
  config.run.out = out("two");
  config.run.threads = 2;
  int in_first = 0, in_second = 0;
  for (int asked = 2; run(config, asked).value == record::RunOutcome::kInterrupted; asked += 2)
    ++(std::filesystem::exists(out("two") / "motions" / "other.npz") ? in_second : in_first);
  EXPECT_GT(in_first, 0);
  EXPECT_GT(in_second, 0);
  EXPECT_TRUE(entry("two", 0).ok && entry("two", 1).ok);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(PlanMotions, AddsSubstepsToAFinishedMotionFromItsPlan) {
  PlanMotionsConfig config = planning("run", {stand});
  run(config);
  auto before = run::results_of(out("run"));
  const auto written = std::filesystem::last_write_time(out("run") / "plans" / "stand.npz");
  config.run.substeps = true;
  run(config);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "plans" / "stand.npz"), written) << "planned again";
  auto after = run::results_of(out("run"));
  EXPECT_EQ(after.erase("substeps/stand.npz"), 1u);
  EXPECT_EQ(after, before);
}

TEST_F(PlanMotions, AddsGainsToAFinishedPlanWithoutReplanning) {
  PlanMotionsConfig config = planning("run", {stand});
  run(config);
  auto before = run::results_of(out("run"));
  const auto written = std::filesystem::last_write_time(out("run") / "plans" / "stand.npz");
  config.run.gains = true;
  run(config);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "plans" / "stand.npz"), written) << "planned again";
  auto after = run::results_of(out("run"));
  const std::string gains = after.at("gains/stand.npz");
  after.erase("gains/stand.npz");
  EXPECT_EQ(after, before);
  const std::vector<Eigen::MatrixXf> K = files::read_gains(out("run") / "gains" / "stand.npz").gains;
  ASSERT_EQ(K.size(), 19u);
  for (const Eigen::MatrixXf& one : K) EXPECT_GT(one.norm(), 0.0f);
  config.run.out = out("at once");
  config.run.threads = 2;
  run(config);
  EXPECT_EQ(run::results_of(out("at once")).at("gains/stand.npz"), gains);
}

TEST_F(PlanMotions, SubstepsAndGainsOfEarlierCommandsStay) {
  PlanMotionsConfig config = planning("run", {stand});
  config.run.substeps = true;
  run(config);
  const auto steps = run::results_of(out("run"));
  config.run.substeps = false;
  config.run.gains = true;
  run(config);
  auto both = run::results_of(out("run"));
  ASSERT_TRUE(both.contains("gains/stand.npz"));
  config.run.gains = false;
  config.run.substeps = true;
  std::filesystem::remove(out("run") / "motions" / "stand.npz");
  run(config);
  EXPECT_TRUE(run::results_of(out("run")) == both);
  both.erase("gains/stand.npz");
  EXPECT_TRUE(both == steps);
}

TEST_F(PlanMotions, IgnoresThePlanOfAnotherInput) {
  run(planning("run", {stand}));
  motion::write_clip(stand, motion::standing_clip(25));
  run(planning("run", {stand}));
  EXPECT_EQ(files::read_plan(out("run") / "plans" / "stand.npz").plan.states.size(), 25u);
  EXPECT_EQ(entry("run").frames, 25);
}

TEST_F(PlanMotions, PlanOfAnotherReferenceOrSimulationIsMadeAgain) {
  const PlanMotionsConfig config = planning("run", {stand});
  run(config);
  const auto made = run::results_of(out("run"));
  const std::filesystem::path plan = out("run") / "plans" / "stand.npz";
  for (const bool simulation : {false, true}) {
    files::StoredPlan stored = files::read_plan(plan);
    if (simulation)
      stored.simulation.friction = 0.9;
    else
      stored.reference.at(10).p_root.x += 1e-9;
    files::write_plan(plan, stored);
    std::filesystem::remove(out("run") / "motions" / "stand.npz");
    run(config);
    EXPECT_TRUE(run::results_of(out("run")) == made) << simulation;
  }
}

// A removed manifest makes a new run of the folder, which may have other settings.
TEST_F(PlanMotions, RunWithoutItsManifestReusesNoPlanAlsoAfterAnInterruption) {
  PlanMotionsConfig config = planning("run", {other});
  run(config);
  make_folder(out("run") / "fits");  // as if it had keypoints, and had been fitted to them
  std::filesystem::copy_file(out("run") / "inputs" / "other.npz", out("run") / "fits" / "other.npz");
  std::filesystem::remove(out("run") / "manifest.json");
  config.run.force = true;
  config.planning.plan.weights.position += 1.0;
  EXPECT_EQ(run(config, 2).value, record::RunOutcome::kInterrupted);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  config.run.out = out("fresh");
  run(config);
  EXPECT_TRUE(run::results_of(out("run")) == run::results_of(out("fresh")));
}

TEST_F(PlanMotions, ChangedInputLeavesNoFileOfItsOldResultAlsoAfterAnInterruption) {
  PlanMotionsConfig config = planning("run", {stand});
  config.run.substeps = config.run.gains = true;
  run(config);
  // As an input with keypoints and a training leave them.
  for (const char* name :
       {"fits/stand.npz", "policies/stand.npz", "training/stand.csv", "training/stand.falls.csv"}) {
    make_folder((out("run") / name).parent_path());
    write_file_atomically(out("run") / name, "of the old input");
  }
  motion::write_clip(stand, motion::standing_clip(30));
  config.run.substeps = config.run.gains = false;
  EXPECT_EQ(run(config, 2).value, record::RunOutcome::kInterrupted);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  config.run.out = out("fresh");
  run(config);
  EXPECT_TRUE(run::results_of(out("run")) == run::results_of(out("fresh")));
}

TEST_F(PlanMotions, FailedPlanSaysWhereAndWhyInManifestFeasibilityAndReportAndOthersFinish) {
  EXPECT_EQ(run(planning("run", {lean, stand})).value, record::RunOutcome::kSomeFailed);
  const record::SequenceEntry lost = entry("run", 0), done = entry("run", 1);
  EXPECT_FALSE(lost.ok);
  EXPECT_EQ(lost.ending, record::SequenceEnding::kLost);
  EXPECT_EQ(lost.output, "rejected/lean.npz");
  EXPECT_LT(value_of(lost.plan, "frames"), 30);
  for (const char* words :
       {"the plan fails at frame ", ": the ", " is 0.", " m from its reference",
        "the reference is not feasible there: frames ", "the body tips over; ", " N m would have to hold it",
        "; with assistive forces the body passes frames 0-", " N m turn it", "limit 0.5 m"})
    EXPECT_NE(lost.reason.find(words), std::string::npos) << words << ": " << lost.reason;
  EXPECT_EQ(lost.reason.find('_'), std::string::npos) << "names of our own: " << lost.reason;
  EXPECT_GT(value_of(lost.feasibility, "infeasible_share"), 0.1);
  EXPECT_EQ(value_of(done.feasibility, "infeasible_share"), 0.0);
  EXPECT_EQ(read_npz(out("run") / "rejected" / "lean.npz").at("poses").shape.at(0), 30u);
  EXPECT_TRUE(done.ok) << done.reason;

  const record::RunFolder made{out("run")};
  const record::FrameFeasibility needs = record::read_feasibility(made.feasibility("lean"));
  ASSERT_EQ(needs.need.size(), 30u);
  double need = 0.0, assistance = 0.0;
  for (const Vector6d& w : needs.need) need = std::max(need, w.tail<3>().norm());
  for (const Vector6d& w : needs.assistance) assistance = std::max(assistance, needs.acceleration(w));
  EXPECT_EQ(need, value_of(lost.feasibility, "force_max_N"));
  EXPECT_EQ(assistance, value_of(lost.feasibility, "help_accel_max_m_s2"));
  EXPECT_EQ(needs.assistance.size(), value_of(lost.feasibility, "help_frames"));
  EXPECT_EQ(needs.wrong.at(15), "tips");
  // To lean needs the weight on the arm by which the centre of mass is beside the feet, and so does the
  // assisted stage.
  const double weight = kGravity * needs.mass;
  EXPECT_GT(needs.need.at(15).head<3>().norm(), 0.2 * weight);
  EXPECT_GT(needs.assistance.at(15).norm(), 0.1 * weight);

  const record::FrameFeasibility feasible = record::read_feasibility(made.feasibility("stand"));
  EXPECT_EQ(feasible.need.size(), 20u);
  EXPECT_TRUE(feasible.assistance.empty());
  EXPECT_TRUE(std::isnan(value_of(done.feasibility, "help_frames")));
  for (const std::string& word : feasible.wrong) EXPECT_EQ(word, "feasible");
  const std::string page = read_file(made.report());
  EXPECT_NE(page.find("\"help\":{\"force\":["), std::string::npos);
  EXPECT_NE(page.find("\"tips\""), std::string::npos);
}

// A run without its first steps: the body is thrown in full speed. Plans without assistance fail there.
TEST_F(PlanMotions, FollowsAnInfeasibleReferenceByAssistiveForces) {
  const auto run_clip = std::filesystem::path(MIMICX_SHARED_DIR) / "motions/deepmimic/humanoid3d_run.txt";
  if (!std::filesystem::exists(run_clip)) GTEST_SKIP() << "no real motions beside the source tree";
  PlanMotionsConfig config = plan_configuration();
  config.run.inputs = {run_clip.string()};
  config.run.out = out("run");
  config.run.threads = 2;
  run(config);
  const record::SequenceEntry followed = entry("run");
  EXPECT_TRUE(followed.ok) << followed.reason;
  EXPECT_EQ(value_of(followed.plan, "by_way_of_help"), 1.0);
  EXPECT_GT(value_of(followed.feasibility, "help_force_max_N"), 30.0);
  // What is written has no assistance: its own forces explain it.
  EXPECT_LT(value_of(followed.audit, "root_force_max_N"), 10.0);
  for (const std::string& note : followed.notes) EXPECT_EQ(note.find("audit"), std::string::npos) << note;
}

TEST_F(PlanMotions, RecordsTheTimeLimitAndTheSameCommandContinues) {
  PlanMotionsConfig config = planning("run", {other});
  config.run.limit_seconds = 1e-9;
  run(config);
  EXPECT_EQ(entry("run").ending, record::SequenceEnding::kLimitSeconds);
  EXPECT_EQ(value_of(entry("run").plan, "frames"), 1);
  config.run.limit_seconds = 0.0;
  run(config);
  EXPECT_EQ(entry("run").ending, record::SequenceEnding::kFollowed);
  EXPECT_TRUE(entry("run").ok) << entry("run").reason;
}

TEST_F(PlanMotions, RejectsAFolderOfOtherSettings) {
  PlanMotionsConfig config = planning("run", {stand});
  run(config);
  config.planning.plan.weights.position += 1.0;
  EXPECT_THROW(run(config), std::invalid_argument);
}

TEST_F(PlanMotions, GoesOnWithMoreMotionsButNotWhereASettingIsNoneToday) {
  PlanMotionsConfig config = planning("run", {stand});
  run(config);
  const auto before = run::results_of(out("run"));
  run(config);
  EXPECT_TRUE(run::results_of(out("run")) == before) << "all of it is done";
  config.run.inputs.push_back(other);
  run(config);
  const std::filesystem::path path = out("run") / "manifest.json";
  record::Manifest manifest = record::read_manifest(path);
  EXPECT_EQ(manifest.sequences.size(), 2u) << "it goes on with more motions";
  manifest.settings.emplace_back("plan_trusted", 0.3);
  write_file_atomically(path, record::format_manifest(manifest));
  EXPECT_NE(refusal_of([&] { run(config); }).find("plan_trusted is 0.3 there, not set here"),
            std::string::npos);
}

TEST(PlanningSettings, EveryOneCanBeChangedByItsNameAndChangesNoOther) { check_settings(PlanningConfig{}); }

TEST(PlanningSettings, RejectsImpossibleValuesByName) {
  EXPECT_NO_THROW(check(PlanningConfig{}));
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{{"plan_horizon", 0},
                                                                               {"plan_commit", 0},
                                                                               {"plan_residual", 0},
                                                                               {"plan_position", -1},
                                                                               {"plan_stiffening", 1},
                                                                               {"physics_rate", 100},
                                                                               {"gravity", 0},
                                                                               {"gravity", -9.81}}) {
    PlanningConfig config;
    apply_setting(config, name, value);
    EXPECT_NE(refusal_of([&] { check(config); }).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace mimicx::plan
