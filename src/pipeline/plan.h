/// `mimicx plan`: each motion is planned by optimal control, without any training.    docs/control.md
#pragma once

#include <filesystem>

#include "pipeline/planning.h"
#include "pipeline/sequence_run.h"

namespace mimicx::pipeline {

struct PlanMotionsConfig {
  RunConfig run;
  PlanningConfig planning;
  /// Files of the clusters of options, for the report's map; empty: none.
  std::vector<std::filesystem::path> clusters = {};
};

/// What people run (configurations.h).
PlanMotionsConfig plan_configuration();

/// The settings, as the manifest lists them.
NamedValues settings_of(const PlanMotionsConfig& config);

/// @throws std::invalid_argument as `run_sequences`
record::RunOutcome plan_motions(const PlanMotionsConfig& config, const record::RunContext& context);

}  // namespace mimicx::pipeline
