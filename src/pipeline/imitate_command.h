/// `mimicx imitate`: one policy per motion, trained from scratch.
#pragma once

#include "pipeline/training_loop.h"
#include "run/sequence_run.h"

namespace mimicx::pipeline {

struct ImitateConfig {
  run::RunConfig run;
  TrainingConfig training;
};

/// The settings, as the manifest lists them.
NamedValues manifest_settings(const ImitateConfig& config);

/// @throws std::invalid_argument as `run_sequences`
record::RunOutcome imitate(const ImitateConfig& config, const record::RunContext& context);

}  // namespace mimicx::pipeline
