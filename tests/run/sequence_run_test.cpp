// Several motions of a run at once: the same results as one after the other.
#include <gtest/gtest.h>

#include <fstream>

#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "plan/plan_command.h"
#include "program/small_run.h"
#include "record/outputs.h"
#include "record/shard_list.h"
#include "report/run_report.h"
#include "run/merge.h"
#include "run/results.h"

namespace mimicx::run {
namespace {

struct ParallelRun : testing::Test {
  ParallelRun() {
    static const TemporaryFolder made;  // the inputs of all tests
    for (int k = 0; k < 5; ++k) {
      inputs.push_back((made.path / ("stand" + std::to_string(k) + ".npz")).string());
      motion::write_clip(inputs.back(), motion::standing_clip(24 - 4 * k));  // the first takes longest
    }
  }
  plan::PlanMotionsConfig planning(const std::string& name, int jobs) const {
    plan::PlanMotionsConfig config = plan::plan_configuration();
    config.run.inputs = inputs;
    config.run.out = folder.path / name;
    config.run.threads = 2;
    config.run.jobs = jobs;
    return config;
  }
  static program::Outcome run(const plan::PlanMotionsConfig& config, int asked = -1) {
    return program::run_in_context(
        [&](const record::RunContext& context) { return plan::plan_motions(config, context); }, asked);
  }
  /// Results of one motion after the other; made once.
  const std::map<std::string, std::string>& sequential() const {
    static const std::map<std::string, std::string> made = [&] {
      EXPECT_EQ(run(planning("sequential", 1)).value, record::RunOutcome::kAllGood);
      return results("sequential");
    }();
    return made;
  }
  std::map<std::string, std::string> results(const std::string& name) const {
    return results_of(folder.path / name);
  }

  TemporaryFolder folder;
  std::vector<std::string> inputs;
};

TEST_F(ParallelRun, GivesTheBytesOfASequentialRun) {
  EXPECT_EQ(run(planning("three", 3)).value, record::RunOutcome::kAllGood);
  EXPECT_EQ(run(planning("auto", 0)).value, record::RunOutcome::kAllGood);
  EXPECT_TRUE(sequential() == results("three"));
  EXPECT_TRUE(sequential() == results("auto"));
}

TEST_F(ParallelRun, ContinuesToTheSameBytesAfterAnInterruption) {
  for (const int asked : {2, 5, 9}) {
    const std::string name = "halves" + std::to_string(asked);
    EXPECT_EQ(run(planning(name, 2), asked).value, record::RunOutcome::kInterrupted);
    EXPECT_EQ(run(planning(name, 2)).value, record::RunOutcome::kAllGood);
    EXPECT_TRUE(sequential() == results(name)) << asked;
  }
}

TEST_F(ParallelRun, MergeReusesTheReportClipsOfTheShards) {
  inputs.clear();
  for (int k = 0; k <= report::kMostEmbedded; ++k) {
    inputs.push_back((folder.path / ("stand" + std::to_string(k) + ".npz")).string());
    motion::write_clip(inputs.back(), motion::standing_clip(4));
  }
  EXPECT_EQ(run(planning("whole", 2)).value, record::RunOutcome::kAllGood);
  for (const int index : {1, 0}) {
    plan::PlanMotionsConfig part = planning("parts", 2);
    part.run.shard = {index, 2};
    EXPECT_EQ(run(part).value, record::RunOutcome::kAllGood);
  }
  const std::filesystem::path out = folder.path / "parts";
  ASSERT_TRUE(std::filesystem::exists(out / "report" / "stand50.js"));
  std::filesystem::remove_all(out / "references");  // which a clip cannot be made without
  {
    const RunLocks locks = lock_shards(out);
    write_merged(out, gather_shards(out), false, {});
  }
  auto merged = results("parts"), whole = results("whole");
  std::erase_if(merged, [](const auto& file) { return file.first.starts_with("shards/"); });
  std::erase_if(whole, [](const auto& file) { return file.first.starts_with("references/"); });
  EXPECT_TRUE(merged == whole);
}

TEST_F(ParallelRun, MergeKeepsTheRecordsOfALaterWholeRun) {
  inputs = {inputs[4], (folder.path / "own.npz").string()};
  const std::filesystem::path out = folder.path / "run";
  const auto shards_and_merge = [&](const std::vector<int>& shards) {
    for (const int index : shards) {
      plan::PlanMotionsConfig part = planning("run", 1);
      part.run.shard = {index, 2};
      EXPECT_EQ(run(part).value, record::RunOutcome::kAllGood);
    }
    const RunLocks locks = lock_shards(out);
    GatheredShards gathered = gather_shards(out);
    EXPECT_TRUE(gathered.missing.empty());
    write_merged(out, std::move(gathered), false, {});
  };
  motion::write_clip(inputs[1], motion::standing_clip(8));
  shards_and_merge({0, 1});
  motion::write_clip(inputs[1], motion::standing_clip(9));
  EXPECT_EQ(run(planning("run", 1)).value, record::RunOutcome::kAllGood);
  const auto whole = results("run");
  const std::string times = read_file(out / "timing.json");
  shards_and_merge({});
  EXPECT_TRUE(results("run") == whole);
  EXPECT_EQ(read_file(out / "timing.json"), times);
  motion::write_clip(inputs[1], motion::standing_clip(10));
  shards_and_merge({0, 1});
  EXPECT_EQ(record::read_manifest(out / "manifest.json").sequences.at(1).frames, 10)
      << "the shard's, where its motion is there";
}

TEST_F(ParallelRun, RefusedShardLeavesNoAgreement) {
  inputs = {inputs[4]};
  const std::filesystem::path out = folder.path / "run", foreign = out / "motions" / "stand4.npz";
  std::filesystem::create_directories(foreign.parent_path());
  std::ofstream(foreign) << "years of work";
  plan::PlanMotionsConfig config = planning("run", 1);
  config.run.shard = {0, 2};
  EXPECT_THROW(run(config), record::OutputRefused);
  EXPECT_FALSE(std::filesystem::exists(record::shard_list_path(out)));
  std::filesystem::remove(foreign);
  config.run.shard = {0, 3};
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood) << "nothing was agreed on";
  EXPECT_TRUE(std::filesystem::exists(record::shard_list_path(out)));
}

TEST_F(ParallelRun, FailingInputStopsNoOther) {
  inputs[1] = (folder.path / "gone.npz").string();
  EXPECT_EQ(run(planning("run", 2)).value, record::RunOutcome::kSomeFailed);
  const record::Manifest manifest = record::read_manifest(folder.path / "run" / "manifest.json");
  ASSERT_EQ(manifest.sequences.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(manifest.sequences[k].input, inputs[k]) << "in the inputs' order, whichever is done first";
    EXPECT_EQ(manifest.sequences[k].ok, k != 1);
  }
}

// A disk may be away for an hour, a file may be half copied.
TEST_F(ParallelRun, InputThatCannotBeReadKeepsItsResultAndSaysSo) {
  inputs = {inputs[4], (folder.path / "own.npz").string()};
  for (const int jobs : {1, 2}) {
    const std::string name = "run" + std::to_string(jobs);
    motion::write_clip(inputs[1], motion::standing_clip(8));
    run(planning(name, jobs));
    const auto made = results(name);
    const auto says = [](const program::Outcome& outcome, const std::string& text) {
      return outcome.messages.find(text) != std::string::npos;
    };
    std::ofstream(inputs[1]) << "nothing";
    const program::Outcome damaged = run(planning(name, jobs));
    EXPECT_EQ(damaged.value, record::RunOutcome::kSomeFailed);
    EXPECT_TRUE(says(damaged, "own: failed: " + inputs[1]) && says(damaged, "; its earlier result is kept"))
        << damaged.messages;
    EXPECT_TRUE(results(name) == made);
    std::filesystem::remove(inputs[1]);
    const program::Outcome gone = run(planning(name, jobs));
    EXPECT_EQ(gone.value, record::RunOutcome::kSomeFailed);
    EXPECT_TRUE(says(gone, "; its earlier result is kept")) << gone.messages;
    EXPECT_TRUE(results(name) == made);
    motion::write_clip(inputs[1], motion::standing_clip(9));
    const program::Outcome changed = run(planning(name, jobs));
    EXPECT_EQ(changed.value, record::RunOutcome::kAllGood);
    EXPECT_TRUE(says(changed, "own: " + inputs[1] + " has changed since its result: made again"))
        << changed.messages;
    EXPECT_FALSE(results(name) == made);
  }
}

// A file where a folder has to be, in the place of a full disk.
TEST_F(ParallelRun, ErrorInWorkOnAFinishedMotionKeepsItsResultAndSaysSo) {
  inputs = {inputs[4]};
  const std::filesystem::path out = folder.path / "run";
  plan::PlanMotionsConfig config = planning("run", 1);
  run(config);
  const auto made = results("run");
  const auto keeps = [&](const std::string& in_the_way) {
    std::ofstream(out / in_the_way) << "in the way";
    const program::Outcome outcome = run(config);
    EXPECT_EQ(outcome.value, record::RunOutcome::kSomeFailed);
    EXPECT_NE(outcome.messages.find("stand4: failed: "), std::string::npos) << outcome.messages;
    EXPECT_NE(outcome.messages.find("; its earlier result is kept"), std::string::npos) << outcome.messages;
    std::filesystem::remove(out / in_the_way);
  };
  config.run.substeps = true;  // for which the motion is done again
  keeps("substeps");
  EXPECT_TRUE(results("run") == made);
  config.run.substeps = false;
  std::filesystem::remove_all(out / "inputs");  // which is repaired
  keeps("inputs");
  EXPECT_EQ(run(config).value, record::RunOutcome::kAllGood);
  EXPECT_TRUE(results("run") == made);
}

TEST_F(ParallelRun, InputThatIsAwayKeepsAResultThatTheTimeLimitEnded) {
  inputs = {(folder.path / "own.npz").string()};
  motion::write_clip(inputs[0], motion::standing_clip(8));
  plan::PlanMotionsConfig config = planning("run", 1);
  config.run.limit_seconds = 1e-9;
  run(config);
  const auto made = results("run");
  const record::SequenceEntry entry =
      record::read_manifest(folder.path / "run" / "manifest.json").sequences.at(0);
  ASSERT_EQ(entry.ending, record::SequenceEnding::kLimitSeconds);
  ASSERT_TRUE(made.contains(entry.output));
  std::filesystem::remove(inputs[0]);
  const program::Outcome gone = run(config);
  EXPECT_EQ(gone.value, record::RunOutcome::kSomeFailed);
  EXPECT_NE(gone.messages.find("; its earlier result is kept"), std::string::npos) << gone.messages;
  EXPECT_TRUE(results("run") == made);
}

TEST_F(ParallelRun, PrintsTheMessagesOfAMotionTogether) {
  const std::string said = run(planning("run", 3)).messages;
  for (int k = 0; k < 5; ++k) {
    const std::string name = "stand" + std::to_string(k);
    const std::size_t first = said.find(name + ": "), last = said.rfind(name + ": ok");
    ASSERT_NE(last, std::string::npos) << said;
    for (int other = 0; other < 5; ++other) {
      if (other == k) continue;
      const std::size_t between = said.find("stand" + std::to_string(other) + ": ", first);
      EXPECT_FALSE(between < last) << said;
    }
  }
}

}  // namespace
}  // namespace mimicx::run
