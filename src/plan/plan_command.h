/// `mimicx plan`: each motion is planned by optimal control, without any training.    docs/control.md
#pragma once

#include "plan/plan_settings.h"
#include "run/sequence_run.h"

namespace mimicx::plan {

struct PlanMotionsConfig {
  run::RunConfig run;
  PlanningConfig planning;
};

/// The defaults (configurations.h).
PlanMotionsConfig plan_configuration();

/// The settings, as the manifest lists them.
NamedValues manifest_settings(const PlanMotionsConfig& config);

/// @throws std::invalid_argument as `run_sequences`
record::RunOutcome plan_motions(const PlanMotionsConfig& config, const record::RunContext& context);

}  // namespace mimicx::plan
