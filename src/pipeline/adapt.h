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

/// The settings, as the manifest lists them.
NamedValues settings_of(const AdaptConfig& config);

/// @throws std::invalid_argument as `run_sequences`, without options, and for an arrangement that cannot be
RunOutcome adapt(const AdaptConfig& config, const RunContext& context);

}  // namespace mimicx
