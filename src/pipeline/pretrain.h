/// `mimicx pretrain`: a folder of motions in, a set of options out.
///
/// Read → fit → prepare → features → clusters; then, cluster by cluster, the denoising encoder and the
/// policy, trained by PPO on all of the cluster's motions. Clips that cannot be read are named and left out.
///
///     DIR/options.npz              the set
///     DIR/clusters.json            which motion is in which cluster
///     DIR/training/optionK.csv     a row per iteration
///     DIR/checkpoints/optionK.npz  the complete state of the training
///     DIR/manifest.json            inputs, settings, samples and losses
///
/// The same command continues an interrupted run; its files end up the same bytes as those of a run that was
/// never interrupted. With more samples it goes on with what is there, encoders and all; the manifest then
/// names the earlier budgets. They are spent one after the other, so the bytes depend on all budgets, and on
/// nothing else: of one that was begun with the larger budget they differ (it explores longer).
/// What it never does: open any ground truth.
#pragma once

#include "import/motion_file.h"
#include "nn/autoencoder.h"
#include "pipeline/options/clusters.h"
#include "pipeline/options/option_set.h"
#include "pipeline/training.h"
#include "record/run_context.h"

namespace mimicx::pipeline {

struct PretrainConfig {
  std::vector<std::string> inputs;  ///< files and folders
  std::filesystem::path out;
  TrainingConfig training;  ///< its samples are of all options together
  options::ClusterConfig clusters;
  nn::AutoEncoderConfig encoder;
  bool use_encoder = true;  ///< false: policies see the reference itself (an ablation)
  bool fit = false;         ///< move motions onto their keypoints first, where they have any
  import::ReadConfig read;
  bool force = false;  ///< overwrite files that no run made
  int threads = 1;
};

/// The settings, as the manifest lists them.
NamedValues settings_of(const PretrainConfig& config);

/// Steps of an option's encoder: those of the settings, fewer where its policy gets under ten times as many
/// samples, and at least 100.
int encoder_steps(const nn::AutoEncoderConfig& config, std::int64_t samples);

/// Samples of every option: in proportion to the square root of the number of its motions, since what a
/// policy learns on one motion helps it on the next. @param motions  of every option, ≥ 1
std::vector<std::int64_t> share_samples(std::int64_t samples, const std::vector<int>& motions);

record::RunOutcome pretrain(const PretrainConfig& config, const record::RunContext& context);

}  // namespace mimicx::pipeline
