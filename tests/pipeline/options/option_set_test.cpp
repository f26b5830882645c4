#include "pipeline/options/option_set.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/file.h"
#include "core/npz/npz.h"
#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "pipeline/options/constant_option.h"
#include "rl/tracking/tracking_fixture.h"

namespace mimicx::pipeline::options {
namespace {

/// Two options with encoders, and everything that is recorded of them.
OptionSet some_set() {
  const auto clip = rl::tracking::make_tracking_clip(rl::tracking::swaying_reference(10), {});
  OptionSet set;
  for (int k = 0; k < 2; ++k) {
    TrainedOption trained;
    trained.option = constant_option(rl::tracking::kEncodedRest + 8, 0.1F * static_cast<float>(k + 1));
    trained.option.encoder = some_encoder(*clip, static_cast<std::uint64_t>(k));
    trained.description = k == 0 ? "calm" : "lively, and \"steps\"";
    trained.centre.fill(0.1 + k);
    trained.motions = 3 + k;
    trained.samples = 5'000'000'000 + k;
    set.options.push_back(trained);
  }
  return set;
}

TEST(OptionSet, RoundTripIsExact) {
  const TemporaryFolder folder;
  const OptionSet set = some_set();
  write_options(folder.path / "options.npz", set);
  for (const std::filesystem::path& path : {folder.path, folder.path / "options.npz"}) {
    const auto back = read_options(path);
    ASSERT_EQ(back->options.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(back->options[k].description, set.options[k].description);
      EXPECT_EQ(back->options[k].centre, set.options[k].centre);
      EXPECT_EQ(back->options[k].motions, set.options[k].motions);
      EXPECT_EQ(back->options[k].samples, set.options[k].samples);
    }
    write_options(folder.path / "copy.npz", *back);
    EXPECT_EQ(read_file(folder.path / "copy.npz"), read_file(folder.path / "options.npz"));
  }
}

TEST(OptionSet, OnlyActionsThatAreNotTheDefaultAreNamedInTheFile) {
  using rl::tracking::ActionMode;
  const TemporaryFolder folder;
  OptionSet set = some_set();
  for (const ActionMode mode : {ActionMode::kResidual, ActionMode::kAbsolute})
    for (const bool feed_forward : {true, false})
      for (const bool ramp : {true, false}) {
        set.actions = {mode, feed_forward, ramp};
        write_options(folder.path / "options.npz", set);
        const Npz file = read_npz(folder.path / "options.npz");
        EXPECT_EQ(file.has("options.absolute_actions"), mode == ActionMode::kAbsolute)
            << "files of earlier versions, whose actions are residual, are the same bytes";
        EXPECT_EQ(file.has("options.no_feed_forward"), !feed_forward);
        EXPECT_EQ(file.has("options.no_ramp"), !ramp);
        EXPECT_EQ(read_options(folder.path)->actions, set.actions);
      }
}

TEST(OptionSet, BoundOfActionsIsInTheFileIfItIsNotTheDefault) {
  const TemporaryFolder folder;
  OptionSet set = some_set();
  write_options(folder.path / "options.npz", set);
  EXPECT_FALSE(read_npz(folder.path / "options.npz").has("options.max_action"));
  set.actions.max_action = 0.5;
  write_options(folder.path / "options.npz", set);
  EXPECT_EQ(read_options(folder.path)->actions, set.actions);
  EXPECT_NE(set.actions, rl::tracking::ActionSettings{}) << "adapt refuses it";
  EXPECT_NE(actions_in_words(set.actions).find(", max_action=0.5"), std::string::npos);
  Npz damaged = read_npz(folder.path / "options.npz");
  damaged.set("options.max_action", NpyArray::scalar(std::nan("")));
  EXPECT_THROW(options_from(damaged), DataError);
}

TEST(OptionSet, SetsAreNumberedConsecutivelyAndNamedByChecksum) {
  const TemporaryFolder folder;
  write_options(folder.path / "options.npz", some_set());
  const auto set = read_options(folder.path);
  EXPECT_EQ(first_option({set, set, set}, 0), 0);
  EXPECT_EQ(first_option({set, set, set}, 2), 4);
  EXPECT_EQ(checksum_of({set}), set->checksum);
  EXPECT_EQ(checksum_of({set, set}), set->checksum + "+" + set->checksum);
}

TEST(OptionSet, RejectsOtherFilesAndMismatchedStateSizes) {
  const TemporaryFolder folder;
  motion::write_clip(folder.path / "clip.npz", motion::standing_clip(20));
  EXPECT_THROW(read_options(folder.path / "clip.npz"), DataError);
  OptionSet wrong = some_set();
  wrong.options[1].option.encoder.reset();  // its policy is made for an encoded state
  write_options(folder.path / "wrong.npz", wrong);
  EXPECT_THROW(read_options(folder.path / "wrong.npz"), DataError);
}

TEST(OptionSet, RejectsNetworksOfOtherSizes) {
  const TemporaryFolder folder;
  Random random(1);
  const auto network = [&](int inputs, int outputs) {
    return nn::make_mlp<float>({inputs, 4, outputs}, 1.0F, random);
  };
  const auto is_rejected = [&](const auto& change) {
    OptionSet wrong = some_set();
    change(wrong.options[1].option);
    write_options(folder.path / "wrong.npz", wrong);
    try {
      read_options(folder.path / "wrong.npz");
    } catch (const DataError&) {
      return true;
    }
    return false;
  };
  const int pose = rl::tracking::kPoseFeatures, state = rl::tracking::kEncodedRest + 8;
  EXPECT_FALSE(is_rejected([](Option&) {}));
  EXPECT_TRUE(is_rejected([&](Option& option) { option.encoder->encoder = network(pose - 1, 8); }));
  EXPECT_TRUE(is_rejected([&](Option& option) { option.encoder->decoder = network(7, pose); }));
  EXPECT_TRUE(is_rejected([&](Option& option) { option.encoder->decoder = network(8, pose + 1); }));
  EXPECT_TRUE(is_rejected([&](Option& option) { option.encoder->inputs = nn::make_normaliser<float>(3); }));
  EXPECT_TRUE(is_rejected([&](Option& option) { option.agent.critic = network(state, 2); }));
  EXPECT_TRUE(is_rejected([&](Option& option) {
    option = constant_option(rl::tracking::kStateSize, 0.1F);  // the first one sees an encoded state
  }));
}

TEST(OptionSet, RejectsInvalidCountsAndCentres) {
  const TemporaryFolder folder;
  write_options(folder.path / "options.npz", some_set());
  const Npz sound = read_npz(folder.path / "options.npz");
  for (const auto& [name, array] :
       std::vector<std::pair<std::string, NpyArray>>{{"option0.motions", NpyArray::scalar(std::nan(""))},
                                                     {"option0.motions", NpyArray::scalar(1e12)},
                                                     {"option1.samples", NpyArray::scalar(-1.0)},
                                                     {"option1.centre", NpyArray::scalar_text("here")}}) {
    Npz damaged = sound;
    damaged.set(name, array);
    EXPECT_THROW(options_from(damaged), DataError) << name;
  }
  EXPECT_NO_THROW(options_from(sound));
}

}  // namespace
}  // namespace mimicx::pipeline::options
