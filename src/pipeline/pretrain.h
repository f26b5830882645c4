/// `mimicx pretrain`: trains a set of options from a folder of motions.
///
/// Read → fit → prepare → features → clusters; then, cluster by cluster, the denoising encoder and the
/// policy, trained by PPO on all of the cluster's motions. Unreadable clips are named and skipped.
///
///     DIR/options.npz              the set
///     DIR/clusters.json            which motion is in which cluster
///     DIR/training/optionK.csv     a row per iteration
///     DIR/checkpoints/optionK.npz  the complete state of the training
///     DIR/manifest.json            inputs, settings, samples and losses
///
/// The same command continues an interrupted run; its files end up the same bytes as those of an
/// uninterrupted run. With more samples it continues the trained options and encoders, and the manifest names
/// the earlier budgets. The budgets are spent one after the other, so the bytes depend on all budgets and on
/// nothing else. A run that begins with the larger budget gives other bytes, because it explores longer. It
/// never opens any ground truth.
#pragma once

#include "import/motion_file.h"
#include "nn/autoencoder.h"
#include "pipeline/options/clusters.h"
#include "pipeline/options/option_set.h"
#include "pipeline/training_loop.h"
#include "record/progress.h"
#include "run/preparation.h"

namespace mimicx::pipeline {

struct PretrainConfig {
  std::vector<std::string> inputs;  ///< files and folders
  std::filesystem::path out;
  TrainingConfig training;  ///< its samples are of all options together
  options::ClusterConfig clusters{.radius = 2.0, .clusters = std::nullopt, .seed = 1};
  nn::AutoEncoderConfig encoder;
  bool use_encoder = true;  ///< false: policies observe the reference itself (an ablation)
  run::CorrectionConfig correction;
  import::ReadConfig read;
  bool force = false;  ///< overwrite files of other programs
  int threads = 1;
};

/// The settings, as the manifest lists them.
NamedValues manifest_settings(const PretrainConfig& config);

/// Training steps of an option's encoder: those of the settings, but at most a tenth of its policy's samples,
/// and at least 100.
int encoder_steps(const nn::AutoEncoderConfig& config, std::int64_t samples);

/// Samples of every option, proportional to the square root of the number of its motions: what a policy
/// learns on one motion helps it on the next. @param motions  of every option, ≥ 1
std::vector<std::int64_t> share_samples(std::int64_t samples, const std::vector<int>& motions);

record::RunOutcome pretrain(const PretrainConfig& config, const record::RunContext& context);

}  // namespace mimicx::pipeline
