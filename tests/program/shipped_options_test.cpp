// The options in data/options: what they are recorded to be, and of use.
#include <gtest/gtest.h>

#include <sstream>

#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "pipeline/options/clusters.h"
#include "program/configurations.h"
#include "synth/data_set.h"

namespace mimicx::program {
namespace {

const std::filesystem::path kOptions = std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "options";
const std::filesystem::path kTaught = kOptions / "taught";
const std::filesystem::path kSynthetic = std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "synthetic";
const std::filesystem::path kTestSplit = kSynthetic / "test" / "noisy";
const std::filesystem::path kTrainingSplit = kSynthetic / "train" / "noisy";

/// What a run over the first frames of a motion of the test split records.
/// @param work  runs `config`, which says how many samples are drawn, in a context
template <class Config, class Work>
record::SequenceEntry entry_of(Config& config, const std::string& name, std::size_t frames,
                               const Work& work) {
  const TemporaryFolder folder;
  motion::Clip clip = motion::read_clip(kTestSplit / (name + ".npz"));
  clip.rotations.resize(frames), clip.trans.resize(frames), clip.keypoints->uvc.resize(frames);
  motion::write_clip(folder.path / (name + ".npz"), clip);
  config.run.inputs = {(folder.path / (name + ".npz")).string()};
  config.run.out = folder.path / "run";
  config.run.correction.fit = true;
  std::ostringstream messages;
  record::Progress progress(messages, false, record::steady_seconds);
  work(record::RunContext{progress, messages, [] { return false; }});
  return record::read_manifest(config.run.out / "manifest.json").sequences.at(0);
}

record::SequenceEntry adapted(const std::string& name, std::size_t frames,
                              const std::shared_ptr<const pipeline::options::OptionSet>& options,
                              std::int64_t samples = 0) {
  AdaptConfig config = adapt_configuration();
  config.training.samples = samples;
  config.training.evaluate_iterations = 10;
  config.method = AdaptMethod::kOptions;
  config.options = {options};
  return entry_of(config, name, frames, [&](const record::RunContext& context) { adapt(config, context); });
}

record::SequenceEntry untrained(const std::string& name, std::size_t frames) {
  pipeline::ImitateConfig config = imitate_configuration();
  config.training.samples = 0;
  return entry_of(config, name, frames,
                  [&](const record::RunContext& context) { pipeline::imitate(config, context); });
}

TEST(ShippedOptions, MatchTheRecordedChecksumsAndAreSmall) {
  std::uintmax_t size = 0;
  for (const std::filesystem::path& set : {kOptions, kTaught}) {
    EXPECT_NE(read_file(set / "README.md").find(record::file_checksum(set / "options.npz")),
              std::string::npos);
    EXPECT_LE(std::filesystem::file_size(set / "options.npz"), 8'000'000u);
    for (const char* name : {"options.npz", "clusters.json"}) size += std::filesystem::file_size(set / name);
  }
  EXPECT_LE(size, 16'500'000u);
}

TEST(ShippedOptions, WereNotTrainedOnTestSeeds) {
  for (const std::filesystem::path& set : {kOptions, kTaught})
    for (const pipeline::options::MotionCluster& cluster :
         pipeline::options::read_clusters(set / "clusters.json").clusters)
      for (const std::string& member : cluster.members)
        EXPECT_GE(std::stoull(member.substr(member.rfind('_') + 1)), synth::kTrainingSeed) << member;
}

/// The kinds that tell whether what was learnt holds for others.
TEST(ShippedOptions, WereNotTrainedOnThreeKinds) {
  for (const pipeline::options::MotionCluster& cluster :
       pipeline::options::read_clusters(kTaught / "clusters.json").clusters)
    for (const std::string& member : cluster.members)
      for (const char* kind : {"walk_back_", "pick_up_", "martial_"})
        EXPECT_FALSE(member.starts_with(kind)) << member;
}

/// Sorting the members again, as `mimicx pretrain` does by default, gives the clusters of the file.
TEST(ShippedOptions, AreThoseOfTheDefaultRadius) {
  namespace options = pipeline::options;
  const options::Clusters shipped = options::read_clusters(kOptions / "clusters.json");
  List<options::NamedFeatures> motions;
  for (const options::MotionCluster& cluster : shipped.clusters) {
    ASSERT_EQ(cluster.features.size(), cluster.members.size());
    for (int i = 0; i < cluster.features.count(); ++i)
      motions.push_back({cluster.members[static_cast<std::size_t>(i)], cluster.features[i]});
  }
  EXPECT_EQ(motions.size(), 112u);
  options::ClusterConfig settings = pretrain_configuration("small").clusters;
  settings.seed = shipped.settings.seed;
  EXPECT_EQ(shipped.settings.radius, settings.radius);
  EXPECT_EQ(shipped.settings.clusters, std::nullopt);
  const options::Clusters sorted = options::cluster_motions(motions, settings);
  const auto set = options::read_options(kOptions);
  ASSERT_EQ(sorted.clusters.size(), shipped.clusters.size());
  ASSERT_EQ(set->options.size(), shipped.clusters.size());
  for (int c = 0; c < sorted.clusters.count(); ++c) {
    EXPECT_EQ(sorted.clusters[c].members, shipped.clusters[c].members) << c;
    EXPECT_LE(sorted.clusters[c].diameter, settings.radius);
    EXPECT_NEAR(sorted.clusters[c].diameter, shipped.clusters[c].diameter, 1e-9);
    for (int k = 0; k < options::kFeatures; ++k) {
      const double unit = options::feature_units()[k], centre = sorted.clusters[c].centre[k];
      EXPECT_NEAR(centre, shipped.clusters[c].centre[k], 1e-9 * unit) << options::feature_names()[k];
      EXPECT_NEAR(centre, set->options[c].centre[k], 1e-9 * unit) << options::feature_names()[k];
    }
  }
}

/// The training motions of data/synthetic are among those of tools/train_options.
TEST(ShippedOptions, FeaturesAreThoseOfTheTrainingMotionsToday) {
  namespace options = pipeline::options;
  const options::Clusters shipped = options::read_clusters(kOptions / "clusters.json");
  for (const std::string name : {"lunge_101", "squat_101", "walk_101"}) {
    const run::PreparedMotion motion =
        run::prepare_motion(kTrainingSplit / (name + ".npz"), {}, pretrain_configuration("small").correction);
    const options::MotionFeatures features = options::motion_features(motion.reference);
    int found = 0;
    for (const options::MotionCluster& cluster : shipped.clusters)
      for (int i = 0; i < cluster.features.count(); ++i) {
        if (cluster.members[static_cast<std::size_t>(i)] != name) continue;
        ++found;
        for (int k = 0; k < options::kFeatures; ++k)
          EXPECT_NEAR(features[k], cluster.features[i][k], 1e-6 * options::feature_units()[k]) << name;
      }
    EXPECT_EQ(found, 1) << name;
  }
}

TEST(ShippedOptions, FineTuningReducesTheErrorOfAMotionThatTheyFollow) {
  const record::SequenceEntry tuned =
      adapted("squat_1", 174, pipeline::options::read_options(kOptions), 40'000);
  EXPECT_TRUE(tuned.ok_before);
  EXPECT_TRUE(tuned.ok);
  EXPECT_LT(value_of(tuned.metrics, "MPJPE"), 0.85 * value_of(tuned.metrics_before, "MPJPE"));
  EXPECT_LT(1.0 - tuned.reward_after, 0.8 * (1.0 - tuned.reward_before));
}

TEST(ShippedOptions, FollowUnseenMotionsWithoutFalling) {
  const auto options = pipeline::options::read_options(kOptions);
  for (const auto& [name, frames] :
       {std::pair("bow_1", 99u), std::pair("wave_1", 130u),
        std::pair("turn_in_place_1", 90u)}) {  // as many as a zero residual falls in
    const record::SequenceEntry with = adapted(name, frames, options), without = untrained(name, frames);
    EXPECT_TRUE(with.ok) << name << ": " << with.reason;
    EXPECT_FALSE(without.ok) << name << ": a zero residual falls";
    EXPECT_GT(with.reward_after, 2.0 * without.reward_after) << name;
  }
}

}  // namespace
}  // namespace mimicx::program
