#include "pipeline/adapt.h"

#include <stdexcept>

#include "pipeline/train_sequence.h"

namespace mimicx {
namespace {

SimulatedSequence adapt_sequence(const AdaptConfig& config, const Reference& reference,
                                 const SequenceJob& job) {
  const rl::TrackingConfig& tracking = config.training.tracking;
  const auto clip = rl::make_tracking_clip(reference, tracking);
  const ArrangedClip arranged = arrange(clip, tracking, *config.options, config.arrangement);
  SimulatedSequence made = train_sequence(arranged.clip, arranged.agents, config.training, job);
  made.arrangement = stretches_of(arranged.options);
  if (!arranged.breaks.empty())
    made.notes.push_back("no option could follow at " + std::to_string(arranged.breaks.size()) +
                         " frames, first at frame " + std::to_string(arranged.breaks.front()));
  return made;
}

Method method_of(const AdaptConfig& config) {
  Method method;
  method.seed = config.training.seed;
  method.samples = config.training.samples;
  method.settings = settings_of(config.training);
  append(method.settings, run_settings(config.run));
  method.settings.emplace_back("switch_penalty", config.arrangement.switch_penalty);
  method.settings.emplace_back("rescue_reward", config.arrangement.rescue_reward);
  method.options = config.options->checksum;
  method.simulation = config.training.tracking.simulation;
  method.simulate = [&config](const Reference& reference, const SequenceJob& job) {
    return adapt_sequence(config, reference, job);
  };
  return method;
}

}  // namespace

TrainingConfig fine_tuning_defaults() {
  TrainingConfig config;
  config.samples = 3'000'000;
  config.characters = 128;
  config.group_size = 32;
  config.ppo.sigma_start = 0.04;
  config.ppo.sigma_end = 0.02;
  config.ppo.epochs = 6;
  config.ppo.kl_target = 0.16;
  config.ppo.critic_step_size = 1e-3;
  config.stop_reward = 0.985;
  config.stall_evaluations = 12;
  return config;
}

RunOutcome adapt(const AdaptConfig& config, const RunContext& context) {
  if (!config.options) throw std::invalid_argument("adapt: expected options to start from, found none");
  return run_sequences(config.run, method_of(config), context);
}

}  // namespace mimicx
