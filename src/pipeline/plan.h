/// `mimicx plan`: each motion is planned by optimal control, without any training.    docs/control.md
#pragma once

#include "pipeline/planning.h"
#include "pipeline/sequence_run.h"

namespace mimicx {

struct PlanMotionsConfig {
  RunConfig run;
  PlanningConfig planning;
};

/// @throws std::invalid_argument as `run_sequences`
RunOutcome plan_motions(const PlanMotionsConfig& config, const RunContext& context);

}  // namespace mimicx
