#include "plan/plan_command.h"

#include "plan/plan_motion.h"

namespace mimicx::plan {

PlanMotionsConfig plan_configuration() {
  PlanMotionsConfig config;
  config.run.fit = true;  // as adapt, which plans first
  return config;
}

NamedValues settings_of(const PlanMotionsConfig& config) {
  NamedValues settings = planning_settings(config.planning);
  append(settings, settings_of(config.run));
  return settings;
}

record::RunOutcome plan_motions(const PlanMotionsConfig& config, const record::RunContext& context) {
  run::Method method;
  method.name = "plan";
  method.settings = settings_of(config);
  method.simulation = config.planning.simulation;
  method.simulate = [&planning = config.planning](const motion::Reference& reference,
                                                  const run::SequenceJob& job) {
    return plan_sequence(reference, planning, job);
  };
  return run::run_sequences(config.run, method, context);
}

}  // namespace mimicx::plan
