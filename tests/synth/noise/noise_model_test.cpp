#include "synth/noise/noise_model.h"

#include <gtest/gtest.h>

#include "synth/noise/noise_fixtures.h"

namespace mimicx::synth {
namespace {

std::string complaint(const std::vector<std::string>& words) {
  try {
    noise_model(words);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(NoiseModel, IsChosenByNameWithSingleAmplitudesSetByValue) {
  const NoisePreset plain = noise_model({});
  EXPECT_EQ(plain.stature, noise_preset("independent").stature);
  const NoisePreset changed = noise_model({"stature=0", "independent", "swap_rate=2.5"});
  EXPECT_EQ(changed.stature, 0.0);
  EXPECT_EQ(changed.swap_rate, 2.5);
  EXPECT_EQ(changed.drift, plain.drift);
  EXPECT_EQ(noise_model({"vibe", "drift=0.1"}).drift, 0.1);
  EXPECT_EQ(noise_model({"gvhmr"}).depth, noise_preset("gvhmr").depth);
}

TEST(NoiseModel, RejectsUnknownWordsListingTheKnownOnes) {
  EXPECT_NE(complaint({"mystery"}).find("independent, gvhmr, vibe, none"), std::string::npos);
  EXPECT_NE(complaint({"burst_rate=1"}).find("unknown amplitude 'burst_rate'; known: joint_static"),
            std::string::npos);
  for (const char* word : {"drift=", "drift=fast", "drift=1m", "drift=-1", "drift=nan", "drop_share=1.5"})
    EXPECT_FALSE(complaint({word}).empty()) << word;
  EXPECT_EQ(complaint({"drop_share=1.5"}), "noise 'drop_share=1.5': expected 0 to 1 (ratio)");
  EXPECT_EQ(complaint({"drift=-1"}), "noise 'drift=-1': expected 0 to 1e+06 (m/s)");
  EXPECT_EQ(complaint({"jitter_frames=0"}), "noise 'jitter_frames=0': expected 0.01 to 1000 (frames)");
  EXPECT_EQ(noise_model({"height_offset=-0.1"}).height_offset, -0.1);
  EXPECT_FALSE(complaint({"gvhmr", "vibe"}).empty());
}

TEST(Estimate, EqualsTheModelsResultAndHasNoCameraWithoutKeypoints) {
  const motion::Clip& truth = test::truth_of("wave");
  EstimateConfig config;
  config.noise = noise_preset("gvhmr");
  const motion::Clip clip = estimate(truth, config, 7),
                     same = add_noise(truth, {.preset = config.noise, .seed = 7});
  EXPECT_TRUE(clip.rotations == same.rotations && clip.trans == same.trans);
  EXPECT_TRUE(clip.keypoints->uvc == same.keypoints->uvc);
  config.keypoints = {};
  const motion::Clip blind = estimate(truth, config, 7);
  EXPECT_TRUE(blind.rotations == same.rotations && !blind.keypoints);
}

TEST(ClipSeed, DependsOnTheSeedAndOnEveryLetterOfTheName) {
  EXPECT_EQ(clip_seed(1, "walk"), clip_seed(1, "walk"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(2, "walk"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(1, "klaw"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(1, "walk-2"));
}

}  // namespace
}  // namespace mimicx::synth
