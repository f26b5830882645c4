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
  const auto plain = std::get<IndependentPreset>(noise_model({}));
  EXPECT_EQ(plain.stature, independent_preset().stature);
  const auto changed =
      std::get<IndependentPreset>(noise_model({"stature=0", "independent", "swap_rate=2.5"}));
  EXPECT_EQ(changed.stature, 0.0);
  EXPECT_EQ(changed.swap_rate, 2.5);
  EXPECT_EQ(changed.drift, plain.drift);
  EXPECT_EQ(std::get<NoisePreset>(noise_model({"vibe", "drift=0.1"})).drift, 0.1);
  EXPECT_EQ(std::get<NoisePreset>(noise_model({"gvhmr"})).drift, noise_preset("gvhmr-like").drift);
}

TEST(NoiseModel, RejectsUnknownWordsListingTheKnownOnes) {
  EXPECT_NE(complaint({"mystery"}).find("independent, gvhmr, vibe"), std::string::npos);
  EXPECT_NE(complaint({"burst_rate=1"}).find("unknown amplitude 'burst_rate'; known: joint_static"),
            std::string::npos);
  EXPECT_NE(complaint({"gvhmr", "stature=1"}).find("known: joint_static, joint_slow, slow_tau"),
            std::string::npos);
  for (const char* word : {"drift=", "drift=fast", "drift=1m", "drift=-1", "drift=nan", "drop_share=1.5"})
    EXPECT_FALSE(complaint({word}).empty()) << word;
  EXPECT_EQ(complaint({"drop_share=1.5"}), "noise 'drop_share=1.5': expected 0 to 1 (ratio)");
  EXPECT_EQ(complaint({"drift=-1"}), "noise 'drift=-1': expected 0 to 1e+06 (m/s)");
  EXPECT_EQ(complaint({"gvhmr", "slow_tau=0"}), "noise 'slow_tau=0': expected 0.01 to 1000 (s)");
  EXPECT_FALSE(complaint({"gvhmr", "burst_max=1"}).empty());
  EXPECT_FALSE(complaint({"gvhmr", "vibe"}).empty());
}

TEST(Estimate, EqualsTheModelsResultAndHasNoCameraWithoutKeypoints) {
  const motion::Clip& truth = test::truth_of("wave");
  EstimateConfig config;
  config.noise = noise_preset("gvhmr-like");
  const motion::Clip clip = estimate(truth, config, 7), same = add_noise(truth, {.seed = 7});
  EXPECT_TRUE(clip.rotations == same.rotations && clip.trans == same.trans);
  EXPECT_TRUE(clip.keypoints->uvc == same.keypoints->uvc);
  config.keypoints = {};
  const motion::Clip blind = estimate(truth, config, 7);
  EXPECT_TRUE(blind.rotations == same.rotations && !blind.keypoints);
  config.noise = independent_preset();
  EXPECT_TRUE(estimate(truth, config, 7).rotations == add_independent_noise(truth, {.seed = 7}).rotations);
}

TEST(ClipSeed, DependsOnTheSeedAndOnEveryLetterOfTheName) {
  EXPECT_EQ(clip_seed(1, "walk"), clip_seed(1, "walk"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(2, "walk"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(1, "klaw"));
  EXPECT_NE(clip_seed(1, "walk"), clip_seed(1, "walk-2"));
}

}  // namespace
}  // namespace mimicx::synth
