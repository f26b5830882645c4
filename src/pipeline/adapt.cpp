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
  method.settings = settings_of(config);
  method.options = config.options->checksum;
  method.simulation = config.training.tracking.simulation;
  method.simulate = [&config](const Reference& reference, const SequenceJob& job) {
    return adapt_sequence(config, reference, job);
  };
  return method;
}

}  // namespace

NamedValues settings_of(const AdaptConfig& config) {
  NamedValues settings = settings_of(config.training);
  append(settings, settings_of(config.run));
  append(settings, {{"switch_penalty", config.arrangement.switch_penalty},
                    {"rescue_reward", config.arrangement.rescue_reward}});
  return settings;
}

RunOutcome adapt(const AdaptConfig& config, const RunContext& context) {
  if (!config.options) throw std::invalid_argument("adapt: expected options to start from, found none");
  check(config.arrangement);
  return run_sequences(config.run, method_of(config), context);
}

}  // namespace mimicx
