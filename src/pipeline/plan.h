/// `mimicx plan`: each motion is planned by optimal control, without any training.    docs/control.md
#pragma once

#include "pipeline/planning.h"
#include "pipeline/sequence_run.h"

namespace mimicx {

struct PlanMotionsConfig {
  RunConfig run;
  PlanningConfig planning;
};

/// The settings, as the manifest lists them.
NamedValues settings_of(const PlanMotionsConfig& config);

/// @throws std::invalid_argument as `run_sequences`
RunOutcome plan_motions(const PlanMotionsConfig& config, const RunContext& context);

}  // namespace mimicx
