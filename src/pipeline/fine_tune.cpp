#include "pipeline/fine_tune.h"

#include <utility>

#include "pipeline/option_set_choice.h"
#include "pipeline/train_motion.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline {
namespace {

/// Identifies the start of a training: input, options and arrangement. A checkpoint with another start, which
/// a stopped search may have left, is not continued.
std::string start_of_training(const run::SequenceJob& job, const options::OptionSet& set,
                              const List<int>& arrangement) {
  std::string text = set.checksum;
  for (const int option : arrangement) text += ' ' + std::to_string(option);
  return job.input_checksum + ' ' + record::checksum(text);
}

/// Notes for the manifest on the choice of the options.
std::vector<std::string> notes_of(const ChosenSet& chosen, int frames, int sets, bool timed_out) {
  std::vector<std::string> notes;
  const auto one_set = [&](int set) {
    return "set " + std::to_string(set + 1) + " of " + std::to_string(sets);
  };
  if (timed_out)
    notes.push_back("the search for options ended early, at frame " + std::to_string(chosen.last_searched) +
                    " of " + std::to_string(frames) + (sets > 1 ? " with " + one_set(chosen.tried - 1) : "") +
                    ": --limit-seconds");
  if (chosen.success && chosen.set > 0)
    notes.push_back("options of " + one_set(chosen.set) + ": the first that follows the motion");
  if (sets > 1 && !chosen.success && chosen.tried == sets && !timed_out)
    notes.push_back("options of " + one_set(chosen.set) + ": none follows the motion, this is the best");
  const List<int>& breaks = chosen.arranged.breaks;
  if (!breaks.empty())
    notes.push_back("nothing that was tried could follow at " + std::to_string(breaks.size()) +
                    " frames, first at frame " + std::to_string(breaks.front()));
  return notes;
}

}  // namespace

run::SimulatedSequence fine_tune(const motion::Reference& reference, const options::OptionSets& sets,
                                 const options::ArrangementConfig& arrangement,
                                 const TrainingConfig& training, const run::SequenceJob& job) {
  const rl::tracking::TrackingConfig& tracking = training.tracking;
  const auto clip = rl::tracking::make_tracking_clip(reference, tracking);
  run::JobWatch watch{job};
  const ChosenSet chosen =
      choose_set(reference, clip, tracking, sets, arrangement, watch.control().should_stop);
  const options::ArrangedClip& arranged = chosen.arranged;
  if (watch.interrupted) {
    run::SimulatedSequence none;
    none.interrupted = true;
    return none;
  }
  run::SequenceJob rest = run::after_seconds(job, record::steady_seconds() - watch.started);
  rest.input_checksum = start_of_training(job, *sets[chosen.set], arranged.options);
  rl::tracking::TrackingRollout before =
      rl::tracking::roll_out(arranged.clip, tracking, rl::tracking::mean_action(arranged.agents));
  const bool good_enough = training.stop_reward > 0.0 && rl::tracking::stays_with_clip(before) &&
                           before.mean_reward >= training.stop_reward;
  TrainingConfig tuning = training;
  if (good_enough) tuning.samples = 0;
  run::SimulatedSequence made = train_sequence(arranged.clip, arranged.agents, tuning, rest);
  made.before = std::move(before);
  if (good_enough) made.ending = record::SequenceEnding::kThreshold;
  if (watch.timed_out) made.ending = record::SequenceEnding::kLimitSeconds;
  made.method = "options";
  made.arrangement = options::stretches_of(arranged.options);
  for (auto& [frame, option] : made.arrangement) option += options::first_option(sets, chosen.set);
  for (std::string& note : notes_of(chosen, clip->size(), sets.count(), watch.timed_out))
    made.notes.push_back(std::move(note));
  return made;
}

}  // namespace mimicx::pipeline
