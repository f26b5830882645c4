/// Which options of a set act in which frames of a motion, and the clip made ready for them.
///                                                                          docs/method.md §8, §9
/// The options run side by side over the clip (side_by_side.h); from their rewards the selector takes the
/// arrangement of largest value (selector.h). The options that occur in it are kept, in the order of the set,
/// and numbered anew from 0: joint fine-tuning trains the policies that act and no others.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "pipeline/options/option_set.h"

namespace mimicx::pipeline::options {

struct ArrangementConfig {
  double switch_penalty = 0.0;  ///< w_p of Eq. 4, in rewards; ≤ 0
  double rescue_reward = 0.0;   ///< σ: a character of less reward is put into the best one's state
};

/// @throws std::invalid_argument unless the penalty is finite and at most 0, and σ in [0, 1]
void check(const ArrangementConfig& config);

struct ArrangedClip {
  List<int> options;       ///< [frames] the option that acts, its number in the set
  List<int> breaks;        ///< frames at which no option of the set could follow
  List<int> kept;          ///< numbers in the set of the options that occur, ascending
  List<rl::Agent> agents;  ///< of the kept options
  std::shared_ptr<const rl::tracking::TrackingClip>
      clip;  ///< as the kept options see it, with their arrangement
};

/// @param clip  as `make_tracking_clip` gives it: not encoded, without an arrangement
/// @throws std::invalid_argument as `check`
ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config);

/// {first frame, option} of every stretch of frames in which one option acts.
std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options);

}  // namespace mimicx::pipeline::options
