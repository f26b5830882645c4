/// Which of several sets of options is used for a motion.                                docs/method.md §8
///
/// Options of different trainings may observe their reference differently (options/option.h), so one
/// arrangement has options of one set only. Sets are tried in their order until the arrangement of one
/// follows the whole motion without fine-tuning. If none does, the best is taken (choice.h), of equals the
/// first.
#pragma once

#include "pipeline/options/arrangement.h"

namespace mimicx::pipeline {

struct ChosenSet {
  int set = 0;            ///< its index
  bool success = false;   ///< its arrangement follows the whole motion; not computed for a single set
  int tried = 0;          ///< sets whose search began
  int last_searched = 0;  ///< frames that the last search reached; fewer than the motion has: it was stopped
  options::ArrangedClip arranged;
};

/// @param clip  of the reference, as `options::arrange` takes it
/// @param should_stop  as there; a stopped search is the last one, and is taken only if it is the first
/// @throws std::invalid_argument as `options::arrange`, and without a set
ChosenSet choose_set(const motion::Reference& reference,
                     const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const options::OptionSets& sets,
                     const options::ArrangementConfig& config, const std::function<bool()>& should_stop = {});

}  // namespace mimicx::pipeline
