/// `mimicx adapt`: trained options are arranged over each motion, and those that act are fine-tuned jointly.
///                                                                     METHOD: docs/method.md §8, §9
#pragma once

#include <memory>

#include "pipeline/options/arrangement.h"
#include "pipeline/sequence_run.h"
#include "pipeline/training.h"

namespace mimicx {

struct AdaptConfig {
  RunConfig run;
  TrainingConfig training;  ///< of the fine-tuning; the networks are the options' own
  ArrangementConfig arrangement;
  std::shared_ptr<const OptionSet> options;  ///< to start from
};

/// What fine-tuning changes in the defaults: it starts from options, so it explores less, spends less, and
/// ends where the motion is good enough or nothing improves any more.    docs/method.md §9
TrainingConfig fine_tuning_defaults();

/// @throws std::invalid_argument as `run_sequences`, and without options
RunOutcome adapt(const AdaptConfig& config, const RunContext& context);

}  // namespace mimicx
