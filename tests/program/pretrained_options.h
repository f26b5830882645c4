/// A folder of motions, options pre-trained on them in seconds, and runs that start from those options.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "motion/synthetic_clip.h"
#include "program/small_run.h"

namespace mimicx::program {

/// Two kinds of motion that cluster apart, as a folder of files.
struct PretrainedOptions : testing::Test {
  /// The motions of all tests, made once.
  static const std::filesystem::path& made_motions() {
    static const TemporaryFolder made;
    if (std::filesystem::is_empty(made.path)) {
      motion::write_clip(made.path / "stand.npz", motion::standing_clip(20));
      motion::write_clip(made.path / "sway.npz", motion::standing_clip(25));
      motion::write_clip(made.path / "walk.npz", test::synthetic_clip("walk", 0, 45));
    }
    return made.path;
  }
  /// Motions of this test alone, which it may change.
  void copy_motions() {
    motions = folder.path / "motions";
    std::filesystem::copy(made_motions(), motions);
  }
  pipeline::PretrainConfig pretraining(const std::string& out) const {
    pipeline::PretrainConfig config = pretrain_configuration("small");
    config.inputs = {motions.string()};
    config.out = folder.path / out;
    config.training = small_training();
    config.training.evaluate_iterations = 2;
    config.clusters.clusters = 2;
    config.encoder.steps = 30;
    config.encoder.hidden = 16;
    config.encoder.code = 8;
    return config;
  }
  /// What `run(pretraining(out))` leaves; trained once for all tests.
  void pretrain_once(const std::string& out) const {
    static const TemporaryFolder made;
    if (std::filesystem::is_empty(made.path)) {
      pipeline::PretrainConfig config = pretraining({});
      config.inputs = {made_motions().string()};
      config.out = made.path;
      EXPECT_EQ(run(config), record::RunOutcome::kAllGood);
    }
    std::filesystem::copy(made.path, folder.path / out, std::filesystem::copy_options::recursive);
  }
  static record::RunOutcome run(const pipeline::PretrainConfig& config, int iterations = -1) {
    return run_in_context(
               [&](const record::RunContext& context) { return pipeline::pretrain(config, context); },
               iterations)
        .value;
  }
  AdaptConfig adapting(const std::string& out, const std::string& options) const {
    AdaptConfig config = adapt_configuration();
    config.method = AdaptMethod::kOptions;
    config.run.inputs = {(motions / "sway.npz").string()};
    config.run.out = folder.path / out;
    config.training = small_training();
    config.training.evaluate_iterations = 2;
    config.arrangement.switch_penalty = -0.01;
    config.options = {pipeline::options::read_options(folder.path / options)};
    return config;
  }
  /// What `run(config)` leaves in a folder; it runs once for all tests that ask for it by the same name.
  void adapt_once(const std::string& name, const AdaptConfig& config) const {
    static const TemporaryFolder made;
    if (!std::filesystem::exists(made.path / name)) {
      AdaptConfig first = config;
      first.run.out = made.path / name;
      run(first);
    }
    std::filesystem::copy(made.path / name, config.run.out, std::filesystem::copy_options::recursive);
  }
  static record::RunOutcome run(const AdaptConfig& config, int iterations = -1) {
    return run_in_context([&](const record::RunContext& context) { return adapt(config, context); },
                          iterations)
        .value;
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
  std::filesystem::path motions = made_motions();
};

}  // namespace mimicx::program
