/// Which of several sets of options a motion is given to.                                docs/method.md §8
///
/// Options that were trained apart may see their reference differently (options/option.h), so those of two
/// sets do not meet in one arrangement. Sets are tried in their order until the arrangement of one follows
/// the whole motion by itself; where none does, the best of them is taken (choice.h), of equals the first.
#pragma once

#include "pipeline/options/arrangement.h"

namespace mimicx::pipeline {

struct ChosenSet {
  int set = 0;            ///< its number
  bool success = false;   ///< its arrangement follows the whole motion; not looked at where there is one set
  int tried = 0;          ///< sets whose search was begun
  int last_searched = 0;  ///< frames that the last of these came to; less than it has: told to stop
  options::ArrangedClip arranged;
};

/// @param clip  of the reference, as `options::arrange` takes it
/// @param should_stop  as there; a search that is stopped is the last, and is not taken unless it is the
/// first
/// @throws std::invalid_argument as `options::arrange`, and without a set
ChosenSet choose_set(const motion::Reference& reference,
                     const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const options::OptionSets& sets,
                     const options::ArrangementConfig& config, const std::function<bool()>& should_stop = {});

}  // namespace mimicx::pipeline
