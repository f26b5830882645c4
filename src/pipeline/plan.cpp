#include "pipeline/plan.h"

#include "pipeline/plan_sequence.h"

namespace mimicx {

RunOutcome plan_motions(const PlanMotionsConfig& config, const RunContext& context) {
  Method method;
  method.name = "plan";
  method.settings = planning_settings(config.planning);
  append(method.settings, run_settings(config.run));
  method.simulation = config.planning.simulation;
  method.simulate = [&planning = config.planning](const Reference& reference, const SequenceJob& job) {
    return plan_sequence(reference, planning, job);
  };
  return run_sequences(config.run, method, context);
}

}  // namespace mimicx
