// Pre-training, and what adapts motions with its result.
#include "pipeline/options/option_set.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>
#include <sstream>

#include "core/error.h"
#include "core/npz.h"
#include "motion/synth/synth.h"
#include "pipeline/adapt.h"
#include "pipeline/pretrain.h"
#include "pipeline/results.h"
#include "pipeline/standing_clip.h"
#include "pipeline/temporary_folder.h"

namespace mimicx {
namespace {

TrainingConfig small_training() {
  TrainingConfig training;
  training.samples = 6 * 64 * 8;
  training.characters = 64;
  training.group_size = 16;
  training.hidden = {16};
  training.evaluate_iterations = 2;
  training.ppo.horizon = 8;
  training.ppo.minibatch = 256;
  training.ppo.pass_rows = 64;
  return training;
}

/// @param iterations  asks to stop after that many; negative: never
template <class Work>
RunOutcome with_context(const Work& work, int iterations = -1) {
  std::ostringstream messages;
  Progress progress(messages, false, steady_seconds);
  int asked = 0;
  return work(RunContext{progress, messages, [&] { return ++asked == iterations; }});
}

/// Two kinds of motion that cluster apart, as a folder of files.
struct Options : testing::Test {
  void SetUp() override {
    std::filesystem::create_directories(motions);
    write_clip(motions / "stand.npz", standing_clip(20));
    write_clip(motions / "sway.npz", standing_clip(25));
    SynthOptions walk;
    walk.kind = "walk";
    write_clip(motions / "walk.npz", synthesize(walk));
  }
  PretrainConfig pretraining(const std::string& out) const {
    PretrainConfig options;
    options.inputs = {motions.string()};
    options.out = folder.path / out;
    options.training = small_training();
    options.clusters.clusters = 2;
    options.encoder.steps = 30;
    options.encoder.hidden = 16;
    options.encoder.code = 8;
    return options;
  }
  static RunOutcome run(const PretrainConfig& options, int iterations = -1) {
    return with_context([&](const RunContext& context) { return pretrain(options, context); }, iterations);
  }
  AdaptConfig adapting(const std::string& out, const std::string& options) const {
    AdaptConfig config;
    config.run.inputs = {(motions / "sway.npz").string()};
    config.run.out = folder.path / out;
    config.run.fit = true;
    config.training = small_training();
    config.arrangement.switch_penalty = -0.01;
    config.options = read_options(folder.path / options);
    return config;
  }
  static RunOutcome run(const AdaptConfig& options, int iterations = -1) {
    return with_context([&](const RunContext& context) { return adapt(options, context); }, iterations);
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
  std::filesystem::path motions = folder.path / "motions";
};

TEST(ShareSamples, GoBySquareRootsAndSpendTheBudget) {
  const auto shares = share_samples(700, {1, 4, 16});
  EXPECT_EQ(shares, (std::vector<std::int64_t>{100, 200, 400}));
}

TEST_F(Options, PretrainingLeavesEveryFileTheDocumentationNames) {
  EXPECT_EQ(run(pretraining("run")), RunOutcome::kAllGood);
  const auto files = results_of(out("run"));
  for (const char* name : {"options.npz", "clusters.json", "manifest.json", "training/option0.csv",
                           "training/option1.csv", "checkpoints/option0.npz", "checkpoints/option1.npz"})
    EXPECT_TRUE(files.contains(name)) << name;
  const auto set = read_options(out("run"));
  ASSERT_EQ(set->options.size(), 2u);
  int motions_in_all = 0;
  for (const TrainedOption& option : set->options) {
    motions_in_all += option.motions;
    ASSERT_TRUE(option.option.encoder.has_value());
    EXPECT_EQ(option.option.encoder->code_size(), 8);
    EXPECT_FALSE(option.description.empty());
  }
  EXPECT_EQ(motions_in_all, 3);
  EXPECT_NE(set->options[0].description, set->options[1].description);
}

TEST_F(Options, PretrainingIsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  PretrainConfig options = pretraining("one");
  run(options);
  options.out = out("two");
  options.threads = 2;
  EXPECT_EQ(run(options, 2), RunOutcome::kInterrupted);
  EXPECT_EQ(run(options, 2), RunOutcome::kInterrupted);  // in the second option
  EXPECT_EQ(run(options), RunOutcome::kAllGood);
  EXPECT_EQ(results_of(out("one")), results_of(out("two")));
}

TEST_F(Options, AFinishedPretrainingIsKeptAndOneWhoseOptionsAreGoneIsDoneAgain) {
  EXPECT_EQ(run(pretraining("run")), RunOutcome::kAllGood);
  const auto before = results_of(out("run"));
  const auto written = std::filesystem::last_write_time(out("run") / "clusters.json");
  EXPECT_EQ(run(pretraining("run")), RunOutcome::kAllGood);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "clusters.json"), written);
  std::filesystem::remove(out("run") / "options.npz");
  EXPECT_EQ(run(pretraining("run")), RunOutcome::kAllGood);
  EXPECT_EQ(results_of(out("run")), before);
}

TEST_F(Options, PretrainingNamesWhatItCannotReadAndGoesOn) {
  std::ofstream(motions / "broken.npz") << "no archive";
  EXPECT_EQ(run(pretraining("run")), RunOutcome::kSomeFailed);
  EXPECT_EQ(read_options(out("run"))->options.size(), 2u);
  EXPECT_NE(results_of(out("run")).at("manifest.json").find("broken.npz"), std::string::npos);
}

TEST_F(Options, PretrainingRefusesAFolderOfAnotherRun) {
  PretrainConfig options = pretraining("run");
  run(options);
  options.encoder.code = 4;
  EXPECT_THROW(run(options), std::invalid_argument);
}

TEST_F(Options, TheFileIsReadBackToTheBitAndForeignOnesAreRefused) {
  run(pretraining("run"));
  const auto set = read_options(out("run"));
  write_options(out("copy.npz"), *set);
  EXPECT_EQ(read_file(out("copy.npz")), read_file(out("run") / "options.npz"));
  EXPECT_THROW(read_options(motions / "walk.npz"), DataError);
  OptionSet wrong = *set;
  wrong.options[0].option.encoder.reset();  // the policy no longer fits its state
  write_options(out("wrong.npz"), wrong);
  EXPECT_THROW(read_options(out("wrong.npz")), DataError);
}

TEST_F(Options, AdaptingRecordsArrangementEndingAndWhatTheOptionsDidBefore) {
  run(pretraining("options"));
  run(adapting("run", "options"));
  const Manifest manifest = read_manifest(out("run") / "manifest.json");
  EXPECT_EQ(manifest.options, read_options(out("options"))->checksum);
  const SequenceEntry& entry = manifest.sequences.at(0);
  ASSERT_FALSE(entry.arrangement.empty());
  EXPECT_EQ(entry.arrangement.front()[0], 0);
  EXPECT_EQ(entry.ending, Ending::kBudget);
  EXPECT_FALSE(entry.metrics_before.empty());
  EXPECT_TRUE(entry.fit.empty()) << "no keypoints, no fit";
}

TEST_F(Options, AdaptingWithoutABudgetIsTheOptionsThemselves) {
  run(pretraining("options"));
  AdaptConfig options = adapting("run", "options");
  options.training.samples = 0;
  run(options);
  const SequenceEntry entry = read_manifest(out("run") / "manifest.json").sequences.at(0);
  EXPECT_EQ(entry.samples, 0);
  EXPECT_EQ(entry.reward_before, entry.reward_after);
  EXPECT_EQ(entry.output, "motions/sway.npz");
}

TEST_F(Options, AdaptingIsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  run(pretraining("options"));
  AdaptConfig options = adapting("one", "options");
  run(options);
  options.run.out = out("two");
  options.run.threads = 2;
  EXPECT_EQ(run(options, 3), RunOutcome::kInterrupted);
  run(options);
  EXPECT_EQ(results_of(out("one")), results_of(out("two")));
}

TEST_F(Options, EndingsAreToldApart) {
  run(pretraining("options"));
  AdaptConfig options = adapting("good", "options");
  options.training.stop_reward = 1e-9;  // whatever it does is good enough
  run(options);
  EXPECT_EQ(read_manifest(out("good") / "manifest.json").sequences.at(0).ending, Ending::kThreshold);
  options = adapting("stalled", "options");
  options.training.stall_evaluations = 1;
  options.training.ppo.step_size = options.training.ppo.step_max = options.training.ppo.step_min = 1e-30;
  run(options);
  EXPECT_EQ(read_manifest(out("stalled") / "manifest.json").sequences.at(0).ending, Ending::kStall);
}

TEST(Stall, CountsRollOutsThatFollowAndAreNoBetter) {
  EXPECT_EQ(stall_age(3, 0.020, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.025, 0.020), 4);
  EXPECT_EQ(stall_age(3, 0.015, 0.020), 0) << "markedly better";
  EXPECT_EQ(stall_age(3, 0.700, 0.020), 0) << "it falls again: an earlier roll-out was lucky";
  EXPECT_EQ(stall_age(3, 0.700, 0.900), 0) << "not followed yet";
}

TEST_F(Options, NothingChangesWhereTheTruthIsDeleted) {
  const std::filesystem::path data = std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test";
  std::filesystem::create_directories(out("data"));
  std::filesystem::copy(data / "truth", out("data") / "truth");
  std::filesystem::copy(data / "noisy", out("data") / "noisy");
  run(pretraining("options"));
  AdaptConfig options = adapting("with", "options");
  options.run.inputs = {(out("data") / "noisy" / "stand_1.npz").string()};
  run(options);
  std::filesystem::remove_all(out("data") / "truth");
  options.run.out = out("without");
  run(options);
  const auto with = results_of(out("with"));
  EXPECT_TRUE(with.contains("fits/stand_1.npz")) << "a clip with keypoints is fitted";
  EXPECT_EQ(with, results_of(out("without")));
}

TEST_F(Options, NothingDependsOnKeypointsThatAreNotWanted) {
  const std::filesystem::path noisy =
      std::filesystem::path(MIMICX_SOURCE_DIR) / "data/synthetic/test/noisy/stand_1.npz";
  Clip clip = read_clip(noisy);
  clip.keypoints.reset();
  std::filesystem::create_directories(out("blind"));
  write_clip(out("blind") / "stand_1.npz", clip);
  run(pretraining("options"));
  AdaptConfig options = adapting("seen", "options");
  options.run.fit = false;
  options.run.inputs = {noisy.string()};
  const std::string log = "training/stand_1.csv";
  run(options);
  const std::string with_eq3 = results_of(out("seen")).at(log);
  options.run.keypoints = false;
  options.run.out = out("unwanted");
  run(options);
  const std::string unwanted = results_of(out("unwanted")).at(log);
  options.run.inputs = {(out("blind") / "stand_1.npz").string()};
  options.run.out = out("none");
  run(options);
  EXPECT_EQ(unwanted, results_of(out("none")).at(log));
  EXPECT_NE(unwanted, with_eq3);
}

}  // namespace
}  // namespace mimicx
