// Whole trainings with the default configuration: what docs/results.md promises. Minutes each.
#include <gtest/gtest.h>

#include <iostream>

#include "core/parallel.h"
#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "program/configurations.h"
#include "synth/synthesize.h"

namespace mimicx::program {
namespace {

record::SequenceEntry imitate_one(const std::filesystem::path& input) {
  const TemporaryFolder folder;
  pipeline::ImitateConfig config = imitate_configuration();
  config.run.inputs = {input.string()};
  config.run.out = folder.path / "run";
  config.run.threads = available_threads();
  record::Progress progress(std::cout, false, record::steady_seconds);
  pipeline::imitate(config, {progress, std::cout, [] { return false; }});
  return record::read_manifest(config.run.out / "manifest.json").sequences.at(0);
}

double metric(const record::SequenceEntry& entry, const std::string& name) {
  for (const auto& [known, value] : entry.metrics)
    if (known == name) return value;
  throw std::invalid_argument(name);
}

struct SyntheticLimit {
  const char* kind;
  double millimetres;
};
struct FollowsSynthetic : testing::TestWithParam<SyntheticLimit> {};

TEST_P(FollowsSynthetic, WithinItsGlobalPositionError) {
  const TemporaryFolder folder;
  synth::SynthConfig options;
  options.kind = GetParam().kind;
  motion::write_clip(folder.path / "clip.npz", synth::synthesize(options));
  const record::SequenceEntry entry = imitate_one(folder.path / "clip.npz");
  EXPECT_TRUE(entry.ok) << entry.reason;
  EXPECT_LE(metric(entry, "gMPJPE"), GetParam().millimetres);
}
INSTANTIATE_TEST_SUITE_P(Learning, FollowsSynthetic,
                         testing::Values(SyntheticLimit{"walk", 25.0}, SyntheticLimit{"squat", 20.0}),
                         [](const auto& test) { return std::string(test.param.kind); });

struct FollowsReal : testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(FollowsReal, ToItsEnd) {
  const std::filesystem::path clip = std::filesystem::path(MIMICX_SHARED_DIR) / "motions" / GetParam().second;
  if (!std::filesystem::exists(clip)) GTEST_SKIP() << "no real motions beside the source tree";
  const record::SequenceEntry entry = imitate_one(clip);
  EXPECT_TRUE(entry.ok) << entry.reason;
}
INSTANTIATE_TEST_SUITE_P(
    Learning, FollowsReal,
    testing::Values(std::pair("video_walk", "video/video_walk_level1_filter_amass.npz"),
                    std::pair("video_squat", "video/video_squat_level1_filter_amass.npz"),
                    std::pair("bandai_walk", "amass/bandai_dataset-1_walk_normal_001_poses.npz")),
    [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace mimicx::program
