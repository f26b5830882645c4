#include "pipeline/imitate_command.h"

#include "core/setting.h"
#include "pipeline/train_motion.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline {
namespace {

run::Method imitation_of(const ImitateConfig& config) {
  run::Method method;
  method.name = "imitate";
  method.seed = config.training.seed;
  method.samples = config.training.samples;
  method.settings = manifest_settings(config);
  method.simulation = config.training.tracking.simulation;
  method.simulate = [&training = config.training](const motion::Reference& reference,
                                                  const run::SequenceJob& job) {
    const auto clip = rl::tracking::make_tracking_clip(reference, training.tracking);
    const std::vector<rl::Agent> untrained = {untrained_agent(training)};
    run::SimulatedSequence made = train_sequence(clip, untrained, training, job);
    if (!made.interrupted)
      made.before = rl::tracking::roll_out(clip, training.tracking, rl::tracking::mean_action(untrained));
    made.method = "imitate";
    return made;
  };
  return method;
}

}  // namespace

NamedValues manifest_settings(const ImitateConfig& config) {
  NamedValues settings = settings_of(config.training);
  append(settings, manifest_settings(config.run));
  return settings;
}

record::RunOutcome imitate(const ImitateConfig& config, const record::RunContext& context) {
  return run::run_sequences(config.run, imitation_of(config), context);
}

}  // namespace mimicx::pipeline
