/// A folder of motions, options pre-trained on them in seconds, and runs that start from those options.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "core/temporary_folder.h"
#include "motion/clip_file.h"
#include "motion/standing_clip.h"
#include "program/small_run.h"
#include "synth/synthesize.h"

namespace mimicx::program {

/// Two kinds of motion that cluster apart, as a folder of files.
struct PretrainedOptions : testing::Test {
  void SetUp() override {
    std::filesystem::create_directories(motions);
    motion::write_clip(motions / "stand.npz", motion::standing_clip(20));
    motion::write_clip(motions / "sway.npz", motion::standing_clip(25));
    synth::SynthConfig walk;
    walk.kind = "walk";
    motion::write_clip(motions / "walk.npz", synth::synthesize(walk));
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
  static record::RunOutcome run(const AdaptConfig& config, int iterations = -1) {
    return run_in_context([&](const record::RunContext& context) { return adapt(config, context); },
                          iterations)
        .value;
  }
  std::filesystem::path out(const std::string& name) const { return folder.path / name; }

  TemporaryFolder folder;
  std::filesystem::path motions = folder.path / "motions";
};

}  // namespace mimicx::program
