#include "pipeline/pretrain.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/setting_checks.h"
#include "motion/test_split.h"
#include "program/pretrained_options.h"
#include "run/preparation.h"
#include "run/results.h"

namespace mimicx::pipeline {
namespace {

using Pretrain = program::PretrainedOptions;

TEST(PretrainEncoders, StepsFallWithTheSamplesOfTheirPolicy) {
  const nn::AutoEncoderConfig config;
  EXPECT_EQ(encoder_steps(config, 10'000'000), config.steps);
  EXPECT_EQ(encoder_steps(config, 10 * config.steps), config.steps);
  EXPECT_EQ(encoder_steps(config, 2000), 200);
  EXPECT_EQ(encoder_steps(config, 0), 100);
}

TEST(ShareSamples, AreProportionalToSquareRootsAndSumToTheBudget) {
  const auto shares = share_samples(700, {1, 4, 16});
  EXPECT_EQ(shares, (std::vector<std::int64_t>{100, 200, 400}));
}

TEST_F(Pretrain, LeavesEveryFileTheDocumentationNames) {
  pretrain_once("run");
  const auto files = run::results_of(out("run"));
  for (const char* name : {"options.npz", "clusters.json", "manifest.json", "training/option0.csv",
                           "training/option1.csv", "checkpoints/option0.npz", "checkpoints/option1.npz"})
    EXPECT_TRUE(files.contains(name)) << name;
  const auto set = options::read_options(out("run"));
  ASSERT_EQ(set->options.size(), 2u);
  int motions_in_all = 0;
  for (const options::TrainedOption& option : set->options) {
    motions_in_all += option.motions;
    ASSERT_TRUE(option.option.encoder.has_value());
    EXPECT_EQ(option.option.encoder->code_size(), 8);
    EXPECT_FALSE(option.description.empty());
  }
  EXPECT_EQ(motions_in_all, 3);
  EXPECT_NE(set->options[0].description, set->options[1].description);
}

TEST_F(Pretrain, OptionsAreTrainedOnTheMotionsOfTheirOwnClusterAlone) {
  pretrain_once("run");
  const options::Clusters clusters = options::read_clusters(out("run") / "clusters.json");
  ASSERT_EQ(clusters.clusters.count(), 2);
  std::vector<int> sizes;
  for (const options::MotionCluster& cluster : clusters.clusters)
    sizes.push_back(static_cast<int>(cluster.members.size()));
  for (int k = 0; k < 2; ++k) {
    PretrainConfig alone = pretraining("alone" + std::to_string(k));
    alone.training.samples = share_samples(alone.training.samples, sizes)[static_cast<std::size_t>(k)];
    alone.training.seed += static_cast<std::uint64_t>(k);
    alone.clusters.clusters = 1;
    alone.inputs.clear();
    for (const std::string& member : clusters.clusters[k].members)
      alone.inputs.push_back((motions / (member + ".npz")).string());
    run(alone);
    EXPECT_EQ(read_file(out("run") / "training" / ("option" + std::to_string(k) + ".csv")),
              read_file(out("alone" + std::to_string(k)) / "training" / "option0.csv"));
  }
}

TEST_F(Pretrain, FallsOverTheFramesAreThoseOfAnOptionOfOneMotion) {
  pretrain_once("run");
  const options::Clusters clusters = options::read_clusters(out("run") / "clusters.json");
  for (int k = 0; k < 2; ++k) {
    const std::string falls = "option" + std::to_string(k) + ".falls.csv";
    EXPECT_EQ(std::filesystem::exists(out("run") / "training" / falls),
              clusters.clusters[k].members.size() == 1);
  }
}

TEST_F(Pretrain, IsTheSameBytesForOneAndTwoThreadsAndAfterInterruptions) {
  pretrain_once("one");
  PretrainConfig config = pretraining("two");
  config.threads = 2;
  EXPECT_EQ(run(config, 2), record::RunOutcome::kInterrupted);
  EXPECT_EQ(run(config, 2), record::RunOutcome::kInterrupted);  // in the second option
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(Pretrain, KeepsAFinishedRunAndRemakesMissingOptions) {
  pretrain_once("run");
  const auto before = run::results_of(out("run"));
  const auto written = std::filesystem::last_write_time(out("run") / "clusters.json");
  EXPECT_EQ(run(pretraining("run")), record::RunOutcome::kAllGood);
  EXPECT_EQ(std::filesystem::last_write_time(out("run") / "clusters.json"), written);
  std::filesystem::remove(out("run") / "options.npz");
  EXPECT_EQ(run(pretraining("run")), record::RunOutcome::kAllGood);
  EXPECT_EQ(run::results_of(out("run")), before);
}

TEST_F(Pretrain, ZeroBudgetCheckpointDoesNotChangeOnResume) {
  PretrainConfig config = pretraining("run");
  config.training.samples = 0;
  run(config);
  const auto files = run::results_of(out("run"));
  std::filesystem::remove(out("run") / "options.npz");
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  EXPECT_TRUE(run::results_of(out("run")) == files);
}

TEST_F(Pretrain, NamesUnreadableMotionsAndContinues) {
  copy_motions();
  std::ofstream(motions / "broken.npz") << "no archive";
  EXPECT_EQ(run(pretraining("run")), record::RunOutcome::kSomeFailed);
  EXPECT_EQ(options::read_options(out("run"))->options.size(), 2u);
  EXPECT_NE(run::results_of(out("run")).at("manifest.json").find("broken.npz"), std::string::npos);
}

TEST_F(Pretrain, WithoutFitIgnoresKeypoints) {
  motions = out("motions");
  std::filesystem::create_directories(motions);
  motion::Clip clip = test::beginning_of_stand("noisy", 45);
  motion::write_clip(motions / "stand_1.npz", clip);
  PretrainConfig config = pretraining("seen");
  config.clusters.clusters = 1;
  config.correction.fit = false;
  run(config);
  clip.keypoints.reset();
  motion::write_clip(motions / "stand_1.npz", clip);
  config.out = out("blind");
  run(config);
  EXPECT_EQ(read_file(out("seen") / "training" / "option0.csv"),
            read_file(out("blind") / "training" / "option0.csv"));
}

TEST_F(Pretrain, FittedKeypointsCountWithAndWithoutUnfittedOnes) {
  PretrainConfig config = pretraining("run");
  pretrain_once("run");
  const std::string manifest = read_file(out("run") / "manifest.json");
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
  EXPECT_EQ(read_file(out("run") / "manifest.json"), manifest) << "it is done";
  config.correction.as_is = true;
  config.correction.unfitted_keypoints = true;
  EXPECT_NE(refusal_of([&] { run(config); }).find("settings/fit is true there, false here"),
            std::string::npos);
  config.correction.fit = true;
  config.correction.as_is = false;
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood) << "fitted keypoints count anyway";
}

TEST_F(Pretrain, AsIsHasTheFeaturesOfTheUncorrectedMotion) {
  motions = out("motions");
  std::filesystem::create_directories(motions);
  motion::write_clip(motions / "stand_1.npz", test::beginning_of_stand("noisy", 45));
  PretrainConfig config = pretraining("run");
  config.clusters.clusters = 1;
  config.correction.as_is = true;
  run(config);
  const run::PreparedMotion unchanged = run::prepare_motion(motions / "stand_1.npz", {}, {.as_is = true});
  EXPECT_EQ(options::read_clusters(out("run") / "clusters.json").clusters[0].features[0],
            options::motion_features(unchanged.reference));
}

TEST_F(Pretrain, RejectsAFolderWithAnInvalidManifest) {
  std::filesystem::create_directories(out("run"));
  for (const char* text : {"", "{", "[]", "{}", "{\"run\": 1}"}) {
    std::ofstream(out("run") / "manifest.json") << text;
    EXPECT_THROW(run(pretraining("run")), std::invalid_argument) << text;
  }
}

/// Rows of a training's log, its head apart.
std::vector<std::string> rows_of(const std::string& log) {
  std::vector<std::string> rows;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  rows.erase(rows.begin());
  return rows;
}

TEST_F(Pretrain, MoreSamplesContinueTheSameTrainings) {
  PretrainConfig config = pretraining("run");
  pretrain_once("run");
  auto before = run::results_of(out("run"));
  config.training.samples *= 2;
  const program::Outcome more =
      program::run_in_context([&](const record::RunContext& context) { return pretrain(config, context); });
  EXPECT_EQ(more.value, record::RunOutcome::kAllGood);
  EXPECT_NE(more.messages.find("goes on from a training of 3072 samples"), std::string::npos);
  auto after = run::results_of(out("run"));
  EXPECT_EQ(after.at("clusters.json"), before.at("clusters.json"));
  for (const char* option : {"training/option0.csv", "training/option1.csv"}) {
    const std::vector<std::string> first = rows_of(before.at(option)), all = rows_of(after.at(option));
    ASSERT_GT(all.size(), first.size()) << option;
    for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(all[k], first[k]) << option << ' ' << k;
  }
  const auto there = options::read_options(out("run"));
  EXPECT_GE(there->options[0].samples + there->options[1].samples, config.training.samples);
  EXPECT_NE(after.at("manifest.json").find("\"earlier_samples\": [\n   3072\n  ]"), std::string::npos);
  EXPECT_EQ(run(config), record::RunOutcome::kAllGood) << "done already";
  EXPECT_EQ(run::results_of(out("run")), after);
  config.training.samples /= 2;
  EXPECT_THROW(run(config), std::invalid_argument) << "it has more already";
}

TEST_F(Pretrain, MoreSamplesGiveTheSameBytesWhereverEarlierRunsStopped) {
  PretrainConfig config = pretraining("one");
  const auto with_samples = [&](int times) {
    config.training.samples = times * program::small_training().samples;
    return config;
  };
  pretrain_once("one");
  run(with_samples(2));
  config.out = out("two");
  config.threads = 2;
  EXPECT_EQ(run(with_samples(1), 2), record::RunOutcome::kInterrupted);  // in the first option
  EXPECT_EQ(run(with_samples(2), 1),
            record::RunOutcome::kInterrupted);  // before it has spent the first budget
  EXPECT_EQ(run(with_samples(2), 6), record::RunOutcome::kInterrupted);
  EXPECT_EQ(run(with_samples(2)), record::RunOutcome::kAllGood);
  EXPECT_EQ(run::results_of(out("one")), run::results_of(out("two")));
}

TEST_F(Pretrain, CheckpointsOfOtherSettingsAreNotContinued) {
  pretrain_once("run");
  for (const char* file : {"manifest.json", "options.npz"}) std::filesystem::remove(out("run") / file);
  for (const char* folder : {"run", "fresh"}) {
    PretrainConfig config = pretraining(folder);
    config.training.tracking.reward.pose *= 2.0;
    run(config);
  }
  EXPECT_EQ(run::results_of(out("run")), run::results_of(out("fresh")));
}

TEST_F(Pretrain, MoreSamplesDoNotAllowOtherSettings) {
  PretrainConfig config = pretraining("run");
  pretrain_once("run");
  const auto before = run::results_of(out("run"));
  config.training.samples *= 2;
  config.training.seed += 1;
  EXPECT_THROW(run(config), std::invalid_argument);
  EXPECT_EQ(run::results_of(out("run")), before);
}

TEST_F(Pretrain, RefusesAFolderWithASettingThatIsNoneToday) {
  const PretrainConfig config = pretraining("run");
  pretrain_once("run");
  const std::filesystem::path manifest = out("run") / "manifest.json";
  std::string text = read_file(manifest);
  const std::string opening = "\"settings\": {";
  text.insert(text.find(opening) + opening.size(), "\"step_factor\": 2.0,");
  write_file_atomically(manifest, text);
  EXPECT_NE(refusal_of([&] { run(config); }).find("settings/step_factor is 2.0 there, not set here"),
            std::string::npos);
}

TEST_F(Pretrain, RefusesAFolderOfAnotherRun) {
  PretrainConfig config = pretraining("run");
  pretrain_once("run");
  config.encoder.steps += 1;
  EXPECT_THROW(run(config), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::pipeline
