#include "pipeline/imitate_command.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <numbers>

#include "core/npz/npz.h"
#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "motion/test_split.h"
#include "program/small_run.h"
#include "run/results.h"

namespace mimicx::pipeline {
namespace {

ImitateConfig small_run(const std::filesystem::path& out, const std::vector<std::string>& inputs) {
  ImitateConfig config = program::imitate_configuration();
  config.run.inputs = inputs;
  config.run.out = out;
  config.training = program::small_training();
  return config;
}

/// @param iterations  asks to stop after that many; negative: never
program::Outcome run(const ImitateConfig& config, int iterations = -1) {
  return program::run_in_context([&](const record::RunContext& context) { return imitate(config, context); },
                                 iterations);
}

struct Imitate : testing::Test {
  void SetUp() override {
    motion::write_clip(folder.path / "stand.npz", motion::standing_clip(20));
    motion::write_clip(folder.path / "other.npz", motion::standing_clip(25));
    stand = (folder.path / "stand.npz").string();
    other = (folder.path / "other.npz").string();
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
  std::string stand, other;
};

TEST_F(Imitate, LeavesEveryFileTheDocumentationNames) {
  run(small_run(out("run"), {stand}));
  const auto files = run::results_of(out("run"));
  for (const char* name : {"manifest.json", "report.html", "motions/stand.npz", "inputs/stand.npz",
                           "references/stand.npz", "feasibility/stand.npz", "training/stand.csv",
                           "training/stand.falls.csv", "checkpoints/stand.npz", "clean/stand.npz"})
    EXPECT_TRUE(files.contains(name)) << name;
  EXPECT_EQ(files.size(), 10u);
  EXPECT_TRUE(std::filesystem::exists(out("run") / "timing.json"));
  const record::Table log = record::read_csv(out("run") / "training" / "stand.csv");
  EXPECT_EQ(log.rows.size(), 6u);
  EXPECT_EQ(log.rows.back()[log.column("samples")], 6 * 64 * 8);
}

TEST_F(Imitate, MotionHasAFramePerInputFrame) {
  run(small_run(out("run"), {stand}));
  const Npz motion = read_npz(out("run") / "motions" / "stand.npz");
  for (const auto& [name, shape] :
       std::map<std::string, std::vector<std::size_t>>{{"poses", {20, 66}},
                                                       {"trans", {20, 3}},
                                                       {"joints", {20, 22, 3}},
                                                       {"velocities", {20, 61}},
                                                       {"joint_torques", {20, 55}},
                                                       {"range_torques", {20, 55}},
                                                       {"ground_wrenches", {20, 22, 6}},
                                                       {"self_contact_wrenches", {20, 22, 6}},
                                                       {"foot_force_least", {20, 2, 3}},
                                                       {"foot_force_most", {20, 2, 3}},
                                                       {"foot_force_least_effort", {20, 2, 3}},
                                                       {"body_weight", {}},
                                                       {"reward", {20}},
                                                       {"reward_factors", {20, 6}}})
    EXPECT_EQ(motion.at(name).shape, shape) << name;
}

TEST_F(Imitate, FloorCarriesTheBodysWeight) {
  run(small_run(out("run"), {stand}));
  const auto wrenches = read_npz(out("run") / "motions" / "stand.npz").at("ground_wrenches").to_double();
  double vertical = 0.0;  // of all bodies, mean over frames 5 … 19
  for (std::size_t t = 5; t < 20; ++t)
    for (std::size_t body = 0; body < kBodies; ++body)
      vertical += wrenches[(t * kBodies + body) * 6 + 5] / 15.0;
  const double weight = 9.81 * make_character().total_mass();
  EXPECT_NEAR(vertical / weight, 1.0, 0.002);
}

TEST_F(Imitate, IsTheSameBytesTwiceAndForOneAndTwoThreads) {
  ImitateConfig config = small_run(out("one"), {stand, other});
  run(config);
  config.run.out = out("again");
  run(config);
  config.run.out = out("two");
  config.run.threads = 2;
  run(config);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("again")));
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(Imitate, IsTheSameBytesAfterInterruptions) {
  ImitateConfig config = small_run(out("whole"), {stand, other});
  run(config);
  config.run.out = out("interrupted");
  EXPECT_EQ(run(config, 2).value, record::RunOutcome::kInterrupted);
  EXPECT_EQ(run(config, 7).value, record::RunOutcome::kInterrupted);  // in the second clip
  run(config);
  EXPECT_EQ(run::results_of(out("whole")), run::results_of(out("interrupted")));
}

TEST_F(Imitate, DropsLogRowsAfterTheCheckpoint) {
  ImitateConfig config = small_run(out("whole"), {stand});
  run(config);
  config.run.out = out("killed");
  EXPECT_EQ(run(config, 2).value, record::RunOutcome::kInterrupted);
  // The log is written before the checkpoint: a kill between the two leaves rows too many.
  record::Table log = record::read_csv(out("killed") / "training" / "stand.csv");
  ASSERT_EQ(log.rows.size(), 2u);
  log.rows.push_back(log.rows.back());
  std::ofstream(out("killed") / "training" / "stand.csv") << record::format_csv(log);
  run(config);
  EXPECT_EQ(run::results_of(out("whole")), run::results_of(out("killed")));
}

TEST_F(Imitate, KeepsFinishedMotions) {
  const ImitateConfig config = small_run(out("run"), {stand});
  run(config);
  const auto before = run::results_of(out("run"));
  const auto written = std::filesystem::last_write_time(out("run") / "checkpoints" / "stand.npz");
  run(config);
  EXPECT_EQ(run::results_of(out("run")), before);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "checkpoints" / "stand.npz"), written);
}

// Their samples are fewer than the budget, but a larger one would not continue them, and this one is no
// larger.
TEST_F(Imitate, KeepsFailedMotionsWhoseTrainingEndedBeforeItsBudget) {
  const ImitateConfig config = small_run(out("run"), {stand});
  run(config);
  record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  const auto written = std::filesystem::last_write_time(out("run") / "checkpoints" / "stand.npz");
  using record::SequenceEnding;
  for (const auto& [ending, of_training] : {std::pair{SequenceEnding::kStall, SequenceEnding::kNone},
                                            std::pair{SequenceEnding::kThreshold, SequenceEnding::kNone},
                                            std::pair{SequenceEnding::kLost, SequenceEnding::kStall}}) {
    record::SequenceEntry& entry = manifest.sequences.at(0);
    entry.ok = false;
    entry.samples = 64 * 8;
    entry.ending = ending;
    entry.training_ending = of_training;
    const std::string text = record::format_manifest(manifest);
    write_file_atomically(out("run") / "manifest.json", text);
    for (const int times : {1, 2}) {
      ImitateConfig again = config;
      again.training.samples *= times;
      manifest.samples = again.training.samples;
      run(again);
      EXPECT_EQ(read_file(out("run") / "manifest.json"), record::format_manifest(manifest));
    }
    manifest.samples = config.training.samples;
  }
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "checkpoints" / "stand.npz"), written);
}

TEST_F(Imitate, AddsSubstepsToAFinishedMotionWithoutTraining) {
  ImitateConfig config = small_run(out("run"), {stand});
  run(config);
  auto before = run::results_of(out("run"));
  config.run.substeps = true;
  run(config);
  auto after = run::results_of(out("run"));
  const std::string steps = after.at("substeps/stand.npz");
  after.erase("substeps/stand.npz");
  EXPECT_EQ(after, before);
  config.run.out = out("at once");
  run(config);
  EXPECT_EQ(run::results_of(out("at once")).at("substeps/stand.npz"), steps);
}

TEST_F(Imitate, ForcesExplainTheMotion) {
  run(small_run(out("run"), {stand}));
  const NamedValues audit = record::read_manifest(out("run") / "manifest.json").sequences.at(0).audit;
  EXPECT_LT(value_of(audit, "root_force_max_N"), 0.01);
  EXPECT_LT(value_of(audit, "root_moment_max_Nm"), 0.5);
  EXPECT_EQ(value_of(audit, "torque_violations"), 0.0);
}

TEST_F(Imitate, Eq3UsesKeypointsOnlyIfFittedToThemOrRequested) {
  const std::string noisy = out("stand_1.npz").string();
  motion::write_clip(noisy, test::beginning_of_stand("noisy", 45));
  const auto lowest_projection = [&](bool fit, bool unfitted_keypoints) {
    ImitateConfig config = small_run(out(fit                  ? "fitted"
                                         : unfitted_keypoints ? "requested"
                                                              : "unfitted"),
                                     {noisy});
    config.run.correction.fit = fit;
    config.run.correction.unfitted_keypoints = unfitted_keypoints;
    run(config);
    EXPECT_EQ(value_of(record::read_manifest(config.run.out / "manifest.json").settings, "keypoints"),
              fit || unfitted_keypoints);
    const record::Table log = record::read_csv(config.run.out / "training" / "stand_1.csv");
    double lowest = 1.0;
    for (const auto& row : log.rows) lowest = std::min(lowest, row[log.column("reward_term:projection")]);
    return lowest;
  };
  EXPECT_EQ(lowest_projection(false, false), 1.0);
  EXPECT_LT(lowest_projection(true, false), 1.0);
  EXPECT_LT(lowest_projection(false, true), 1.0);
}

TEST_F(Imitate, StartsOverIfTheInputChanged) {
  const ImitateConfig config = small_run(out("run"), {stand});
  run(config);
  motion::write_clip(stand, motion::standing_clip(25));
  run(config);
  EXPECT_EQ(read_npz(out("run") / "motions" / "stand.npz").at("poses").shape.at(0), 25u);
}

TEST_F(Imitate, RecordsAFailedInputAndContinues) {
  const std::string broken = (folder.path / "broken.npz").string(),
                    none = (folder.path / "none.npz").string();
  std::ofstream(broken) << "not an archive";
  const program::Outcome outcome = run(small_run(out("run"), {broken, none, stand}));
  EXPECT_EQ(outcome.value, record::RunOutcome::kSomeFailed);
  const record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  ASSERT_EQ(manifest.sequences.size(), 3u);
  EXPECT_FALSE(manifest.sequences[0].ok);
  EXPECT_NE(manifest.sequences[0].reason.find("broken.npz"), std::string::npos);
  EXPECT_NE(manifest.sequences[1].reason.find("none.npz"), std::string::npos);
  EXPECT_EQ(manifest.sequences[2].output, "motions/stand.npz");
  EXPECT_TRUE(std::filesystem::exists(out("run") / "motions" / "stand.npz"));
}

TEST_F(Imitate, UnfollowableMotionIsRejected) {
  motion::Clip leaning = motion::standing_clip(60);  // by 45° to the side, for two seconds: it falls
  for (auto& frame : leaning.rotations)
    frame[kPelvis] = log_map(exp_map(Vector3d(0.0, std::numbers::pi / 4, 0.0)) * exp_map(frame[kPelvis]));
  const std::string lean = (folder.path / "lean.npz").string();
  motion::write_clip(lean, leaning);
  EXPECT_EQ(run(small_run(out("run"), {lean, stand})).value, record::RunOutcome::kSomeFailed);
  const record::Manifest manifest = record::read_manifest(out("run") / "manifest.json");
  EXPECT_FALSE(manifest.sequences.at(0).ok);
  EXPECT_EQ(manifest.sequences.at(0).output, "rejected/lean.npz");
  EXPECT_TRUE(std::filesystem::exists(out("run") / "rejected" / "lean.npz"));
  EXPECT_FALSE(std::filesystem::exists(out("run") / "motions" / "lean.npz"));
  EXPECT_TRUE(std::filesystem::exists(out("run") / "motions" / "stand.npz"));
}

TEST_F(Imitate, RetriesAFailedInput) {
  const std::string late = (folder.path / "late.npz").string();
  const ImitateConfig config = small_run(out("run"), {late});
  EXPECT_EQ(run(config).value, record::RunOutcome::kSomeFailed);
  motion::write_clip(late, motion::standing_clip(20));
  run(config);
  EXPECT_EQ(record::read_manifest(out("run") / "manifest.json").sequences.at(0).output, "motions/late.npz");
}

TEST_F(Imitate, RemakesAMissingResultAndKeepsTheOthers) {
  const ImitateConfig config = small_run(out("run"), {stand, other});
  run(config);
  const auto before = run::results_of(out("run"));
  std::filesystem::remove(out("run") / "motions" / "stand.npz");
  std::filesystem::remove(out("run") / "motions" / "other.npz");
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_EQ(run::results_of(out("run")), before);
}

TEST_F(Imitate, RetriesAResultThatCouldNotBeWritten) {
  const ImitateConfig config = small_run(out("run"), {stand, other});
  const std::filesystem::path in_the_way = out("run") / "references" / "stand.npz";
  std::filesystem::create_directories(in_the_way / "folder");
  EXPECT_EQ(run(config).value, record::RunOutcome::kSomeFailed);
  const record::Manifest failed = record::read_manifest(out("run") / "manifest.json");
  ASSERT_EQ(failed.sequences.size(), 2u);
  EXPECT_FALSE(failed.sequences[0].finished()) << failed.sequences[0].reason;
  EXPECT_TRUE(failed.sequences[1].ok) << failed.sequences[1].reason;
  std::filesystem::remove_all(in_the_way);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_TRUE(std::filesystem::exists(out("run") / "motions" / "stand.npz"));
}

TEST_F(Imitate, FailedCopyKeepsTheMotion) {
  ImitateConfig config = small_run(out("run"), {stand});
  config.run.input_rate = true;
  std::filesystem::create_directories(out("run"));
  std::ofstream(out("run") / "clean") << "in the way of a folder";
  EXPECT_EQ(run(config).value, record::RunOutcome::kSomeFailed);
  EXPECT_TRUE(std::filesystem::exists(out("run") / "motions" / "stand.npz"));
  std::filesystem::remove(out("run") / "clean");
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_TRUE(std::filesystem::exists(out("run") / "clean" / "stand.npz"));
}

TEST_F(Imitate, StopsBetweenInputsThatNeedNoTraining) {
  ImitateConfig config = small_run(out("run"), {stand, other});
  config.training.samples = 0;
  EXPECT_EQ(run(config, 1).value, record::RunOutcome::kInterrupted);
  EXPECT_EQ(record::read_manifest(out("run") / "manifest.json").sequences.size(), 1u);
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
}

TEST_F(Imitate, RejectsAFolderOfOtherSettingsUnchanged) {
  ImitateConfig config = small_run(out("run"), {stand});
  run(config);
  const auto before = run::results_of(out("run"));
  config.training.seed = 2;
  EXPECT_THROW(run(config), std::invalid_argument);
  config = small_run(out("run"), {stand});
  config.training.ppo.gamma = 0.5;
  EXPECT_THROW(run(config), std::invalid_argument);
  EXPECT_EQ(run::results_of(out("run")), before);
}

TEST_F(Imitate, RecordsTheTimeLimitAndTheSameCommandContinues) {
  ImitateConfig config = small_run(out("run"), {stand});
  config.run.limit_seconds = 1e-9;
  run(config);
  const record::SequenceEntry stopped = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(stopped.ending, record::SequenceEnding::kLimitSeconds);
  EXPECT_EQ(stopped.samples, 64 * 8);
  EXPECT_EQ(stopped.output, "motions/stand.npz");
  config.run.limit_seconds = 0.0;
  run(config);
  const record::SequenceEntry done = record::read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(done.ending, record::SequenceEnding::kBudget);
  EXPECT_EQ(done.samples, 6 * 64 * 8);
}

TEST_F(Imitate, AnotherSeedGivesAnotherTraining) {
  ImitateConfig config = small_run(out("one"), {stand});
  run(config);
  config.run.out = out("two");
  config.training.seed = 2;
  run(config);
  EXPECT_NE(run::results_of(out("one")).at("training/stand.csv"),
            run::results_of(out("two")).at("training/stand.csv"));
}

}  // namespace
}  // namespace mimicx::pipeline
