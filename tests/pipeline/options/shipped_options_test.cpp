// The options in data/options: what they are recorded to be, and of use.
#include <gtest/gtest.h>

#include <sstream>

#include "motion/synth/set.h"
#include "pipeline/pretrain.h"
#include "pipeline/temporary_folder.h"

namespace mimicx {
namespace {

const std::filesystem::path kOptions = std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "options";
const std::filesystem::path kTestSplit =
    std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "synthetic" / "test" / "noisy";

SequenceEntry adapt(const std::string& name, const std::shared_ptr<const OptionSet>& options) {
  const TemporaryFolder folder;
  RunOptions run;
  run.inputs = {(kTestSplit / (name + ".npz")).string()};
  run.out = folder.path / "run";
  run.training = fine_tuning_defaults();
  run.training.samples = 0;  // the start alone
  run.fit = true;
  run.options = options;
  std::ostringstream messages;
  Progress progress(messages, false, steady_seconds);
  run_sequences(run, {progress, messages, [] { return false; }});
  return read_manifest(run.out / "manifest.json").sequences.at(0);
}

TEST(ShippedOptions, AreTheFileThatTheirPageRecordsAndSmall) {
  const std::string page = read_file(kOptions / "README.md");
  EXPECT_NE(page.find(file_checksum(kOptions / "options.npz")), std::string::npos);
  EXPECT_LE(std::filesystem::file_size(kOptions / "options.npz"), 8'000'000u);
}

TEST(ShippedOptions, WereTrainedOnSeedsThatTheTestSplitDoesNotHave) {
  const Clusters clusters = read_clusters(kOptions / "clusters.json");
  for (const MotionCluster& cluster : clusters.clusters)
    for (const std::string& member : cluster.members)
      EXPECT_GE(std::stoull(member.substr(member.rfind('_') + 1)), kTrainingSeed) << member;
}

TEST(ShippedOptions, FollowMotionsTheyHaveNeverSeenWhereNoPolicyFalls) {
  const auto options = read_options(kOptions);
  for (const char* name : {"squat_1", "wave_1", "turn_in_place_1"}) {
    const SequenceEntry with = adapt(name, options), without = adapt(name, nullptr);
    EXPECT_TRUE(with.ok) << name << ": " << with.reason;
    EXPECT_FALSE(without.ok) << name << ": a zero residual falls";
    EXPECT_GT(with.reward_after, 2.0 * without.reward_after) << name;
  }
}

}  // namespace
}  // namespace mimicx
