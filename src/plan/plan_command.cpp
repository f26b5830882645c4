#include "plan/plan_command.h"

#include "core/setting.h"
#include "plan/plan_motion.h"
#include "plan/plan_parts.h"

namespace mimicx::plan {

PlanMotionsConfig plan_configuration() {
  PlanMotionsConfig config;
  config.run.correction.fit = true;  // as adapt, which plans first
  return config;
}

NamedValues manifest_settings(const PlanMotionsConfig& config) {
  NamedValues settings = settings_of(config.planning);
  append(settings, manifest_settings(config.run));
  return settings;
}

record::RunOutcome plan_motions(const PlanMotionsConfig& config, const record::RunContext& context) {
  run::Method method;
  method.name = "plan";
  method.settings = manifest_settings(config);
  method.simulation = config.planning.simulation;
  method.simulate = [&planning = config.planning](const motion::Reference& reference,
                                                  const run::SequenceJob& job) {
    return plan_sequence(reference, planning, job);
  };
  method.parts = [&planning = config.planning](
                     const motion::Reference& reference, const rl::tracking::TrackingRollout& lost,
                     const run::SequenceJob& job) { return followed_parts(reference, planning, lost, job); };
  return run::run_sequences(config.run, method, context);
}

}  // namespace mimicx::plan
