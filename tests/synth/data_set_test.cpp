#include "synth/data_set.h"
#include "motion/clip_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

namespace mimicx::synth {
namespace {

std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::filesystem::path kept_data() { return std::filesystem::path(MIMICX_SOURCE_DIR) / "data" / "synthetic"; }

/// Paths of the files below a folder, relative to it.
std::set<std::string> files_below(const std::filesystem::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files.insert(std::filesystem::relative(entry.path(), folder).generic_string());
  return files;
}

/// A folder that is empty at the start and gone at the end.
struct Folder {
  std::filesystem::path path;
  explicit Folder(const std::string& name) : path(std::filesystem::path(testing::TempDir()) / name) {
    std::filesystem::remove_all(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

TEST(SynthSet, TakesTheKindsInTurnAndThenTheNextSeed) {
  SynthSetConfig config;
  config.kinds = {"squat", "walk"};
  config.clips = 5;
  config.seed = 101;
  std::vector<std::string> names;
  for (const SynthConfig& clip : clips_of_set(config)) {
    names.push_back(clip.kind + "_" + std::to_string(clip.seed));
    EXPECT_TRUE(clip.betas_from_seed);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"squat_101", "walk_101", "squat_102", "walk_102", "squat_103"}));
}

TEST(SynthSet, HasOneClipOfEachKindByDefault) {
  std::vector<std::string> kinds;
  for (const SynthConfig& clip : clips_of_set({})) {
    kinds.push_back(clip.kind);
    EXPECT_EQ(clip.seed, kTestSeed);
  }
  EXPECT_EQ(kinds, basic_kinds());
}

TEST(SynthSet, RejectsUnknownAndRepeatedKindsNoiseAndCameras) {
  SynthSetConfig config;
  config.kinds = {"walk", "fly"};
  EXPECT_THROW(clips_of_set(config), std::invalid_argument);
  config.kinds = {"walk", "walk"};
  EXPECT_THROW(clips_of_set(config), std::invalid_argument);
  config.kinds = {"walk"};
  config.clips = -1;
  EXPECT_THROW(clips_of_set(config), std::invalid_argument);
  config.clips = 0;
  config.noise = "loud";
  EXPECT_THROW(make_synth_pair({}, config), std::invalid_argument);
  config.noise = "vibe";
  config.camera = "lost";
  EXPECT_THROW(make_synth_pair({}, config), std::invalid_argument);
}

TEST(SynthSet, WritesTruthAndNoisyUnderOneNamePerClip) {
  const Folder folder("mimicx_synth_set");
  SynthSetConfig config;
  config.kinds = {"walk", "wave"};
  config.clips = 3;
  std::vector<std::string> told;
  write_synth_set(folder.path, config, [&](std::size_t index, const motion::Clip& truth) {
    EXPECT_EQ(index, told.size());
    told.push_back(truth.name);
  });
  EXPECT_EQ(told, (std::vector<std::string>{"walk_1", "wave_1", "walk_2"}));
  std::set<std::string> expected;
  for (const std::string& name : told)
    for (const char* half : {"truth/", "noisy/"}) expected.insert(half + name + ".npz");
  EXPECT_EQ(files_below(folder.path), expected);
}

TEST(SynthSet, ClipDoesNotDependOnItsSet) {
  SynthSetConfig all, alone;
  alone.kinds = {"wave"};
  alone.seed = 3;
  const Folder one("mimicx_synth_one"), two("mimicx_synth_two");
  all.kinds = {"stand", "wave"};
  all.seed = 2;
  all.clips = 4;
  write_synth_set(one.path, all);
  write_synth_set(two.path, alone);
  for (const char* file : {"truth/wave_3.npz", "noisy/wave_3.npz"})
    EXPECT_TRUE(file_bytes(one.path / file) == file_bytes(two.path / file)) << file;
}

TEST(SynthSet, GivesEveryClipErrorsOfItsOwn) {
  const auto error = [](const std::string& kind, std::uint64_t seed) {
    SynthConfig clip;
    clip.kind = kind;
    clip.seed = seed;
    const SynthPair pair = make_synth_pair(clip, {});
    return Vector3d(pair.noisy.trans[0] - pair.truth.trans[0]);
  };
  const Vector3d a = error("stand", 1), b = error("stand", 2), c = error("wave", 1);
  EXPECT_GT((a - b).norm(), 1e-3);
  EXPECT_GT((a - c).norm(), 1e-3);
  EXPECT_EQ(a, error("stand", 1));
}

TEST(SynthSet, WithoutNoiseTheEstimateIsTheTruthAndHasKeypoints) {
  SynthSetConfig config;
  config.noise = "none";
  config.camera = "calibrated";
  config.keypoints = motion::KeypointSet::kCoco17;
  const SynthPair pair = make_synth_pair({}, config);
  EXPECT_EQ(pair.noisy.betas, pair.truth.betas);
  for (std::size_t t = 0; t < pair.truth.rotations.size(); ++t) {
    EXPECT_LT((pair.noisy.trans[t] - pair.truth.trans[t]).norm(), 2e-6);
    for (std::size_t b = 0; b < kBodies; ++b)
      EXPECT_LT((pair.noisy.rotations[t][b] - pair.truth.rotations[t][b]).norm(), 2e-6);
  }
  EXPECT_EQ(pair.noisy.keypoints->names, motion::keypoint_names(motion::KeypointSet::kCoco17));
}

TEST(SynthSet, MixedDrawsAPresetForEveryClipAndHalfOfThemHaveNoKeypoints) {
  SynthSetConfig mixed;
  mixed.noise = "mixed";
  std::map<std::string, int> drawn;
  int blind = 0;
  constexpr int kClips = 20;
  for (int i = 0; i < kClips; ++i) {
    SynthConfig clip;
    clip.kind = "stand";
    clip.seconds = 4.0;
    clip.seed = static_cast<std::uint64_t>(i);
    const motion::Clip noisy = make_synth_pair(clip, mixed).noisy;
    for (const char* name : {"gvhmr", "vibe", "independent", "none"}) {
      SynthSetConfig one;
      one.noise = name;
      if (noisy.rotations == make_synth_pair(clip, one).noisy.rotations) ++drawn[name];
    }
    blind += noisy.keypoints ? 0 : 1;
  }
  for (const char* name : {"gvhmr", "vibe", "independent"}) EXPECT_NEAR(drawn[name], 0.3 * kClips, 4) << name;
  EXPECT_EQ(drawn["gvhmr"] + drawn["vibe"] + drawn["independent"] + drawn["none"], kClips);
  EXPECT_GT(drawn["none"], 0);
  EXPECT_NEAR(blind, 0.5 * kClips, 4);
}

TEST(SyntheticData, IsRegeneratedByteForByte) {
  const Folder fresh("mimicx_synthetic_data");
  write_synthetic_data(fresh.path);
  EXPECT_EQ(files_below(fresh.path).size(), 4 * basic_kinds().size());
  SynthSetConfig scenes;
  scenes.kinds = {"stairs_up", "sit_down"};
  write_synth_set(fresh.path / "scenes", scenes);
  const std::set<std::string> files = files_below(fresh.path);
  std::set<std::string> kept = files_below(kept_data());
  for (const std::string& kind : scenes.kinds)  // the truths' scenes, for --scene
    EXPECT_EQ(kept.erase("scenes/scenes/" + kind + "_1.json"), 1u);
  EXPECT_EQ(files, kept);
  std::uintmax_t total = 0;
  for (const std::string& file : files) {
    EXPECT_TRUE(file_bytes(fresh.path / file) == file_bytes(kept_data() / file)) << file;
    total += std::filesystem::file_size(fresh.path / file);
  }
  EXPECT_LE(total, 10'000'000u);
}

TEST(SyntheticData, KeepsTheTruthOutOfTheNoisyFilesAndTheSplitsApart) {
  for (const std::string& kind : basic_kinds()) {
    std::vector<motion::Clip> truths;
    for (const auto& [split, seed] : {std::pair{"test", kTestSeed}, std::pair{"train", kTrainingSeed}}) {
      const std::string name = kind + "_" + std::to_string(seed);
      const motion::Clip truth = motion::read_clip(kept_data() / split / "truth" / (name + ".npz")),
                         noisy = motion::read_clip(kept_data() / split / "noisy" / (name + ".npz"));
      ASSERT_EQ(truth.frames(), noisy.frames());
      ASSERT_TRUE(noisy.keypoints.has_value());
      EXPECT_FALSE(truth.keypoints.has_value());
      EXPECT_TRUE(noisy.passthrough.empty());
      EXPECT_NE(truth.betas, noisy.betas);
      for (std::size_t t = 0; t < truth.trans.size(); ++t)
        EXPECT_GT((truth.trans[t] - noisy.trans[t]).norm(), 1e-4);
      truths.push_back(truth);
    }
    EXPECT_NE(truths[0].betas, truths[1].betas);
    EXPECT_GT((truths[0].rotations[40][kPelvis] - truths[1].rotations[40][kPelvis]).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace mimicx::synth
