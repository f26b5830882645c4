#include "pipeline/option_set_choice.h"

#include <stdexcept>
#include <utility>

#include "judge/choice.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline {

ChosenSet choose_set(const motion::Reference& reference,
                     const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const options::OptionSets& sets,
                     const options::ArrangementConfig& config, const std::function<bool()>& should_stop) {
  if (sets.empty()) throw std::invalid_argument("choose_set: expected a set of options, found none");
  const int acting = clip->size() - 1;
  ChosenSet chosen;
  judge::Candidate best;
  for (int s = 0; s < sets.count() && !best.success; ++s) {
    if (s > 0 && should_stop && should_stop()) break;
    options::ArrangedClip arranged = options::arrange(clip, tracking, *sets[s], config, should_stop);
    chosen.tried = s + 1;
    chosen.last_searched = arranged.searched;
    const bool stopped = arranged.searched < acting;
    if (stopped && s > 0) break;
    if (!stopped && sets.count() > 1) {
      const judge::Candidate found = judge::candidate_of(
          reference,
          rl::tracking::roll_out(arranged.clip, tracking, rl::tracking::mean_action(arranged.agents)));
      if (s > 0 && !judge::better(found, best)) continue;
      best = found;
    }
    chosen.set = s;
    chosen.success = best.success;
    chosen.arranged = std::move(arranged);
    if (stopped) break;
  }
  return chosen;
}

}  // namespace mimicx::pipeline
