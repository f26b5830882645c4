/// Beam search over real roll-outs: which option acts in which frame.   docs/method.md §8
///
/// When options run side by side, every option has its own character, so their rewards do not show what an
/// option does with a character that another option controlled before. Here options continue each other's
/// characters: from each of the best states so far, every option acts for a stretch of frames, and the best
/// resulting states are kept. Paths are compared by Eq. 4 with the rewards of these roll-outs; fallen paths
/// are dropped. If all paths have fallen, the search goes back some stretches and retries with more states
/// and stretches of half the length, until it has passed that frame; every further retry goes back so many
/// more of those and keeps more states. Without retries left, the best path restarts from the reference, and
/// the break is recorded.
///
/// With one stretch as long as the clip, the result is the best single option.
///
/// What it does not do: the result need not be the optimal arrangement, unless the beam holds all paths.
/// Options change only at the ends of stretches.
#pragma once

#include <functional>

#include "pipeline/options/option.h"

namespace mimicx::pipeline::options {

struct SearchConfig {
  int width = 1;                ///< states that are kept, ≥ 1
  int stretch = 1;              ///< shortest stretch of one option, frames, ≥ 1
  double switch_penalty = 0.0;  ///< w_p of Eq. 4, ≤ 0
  int retries = 0;              ///< wider retries where every path has fallen, ≥ 0
};

struct Found {
  List<int> options;        ///< [frames − 1] the option that acts towards the next frame
  double value = 0.0;       ///< R of Eq. 4
  std::vector<int> breaks;  ///< frames at which the last of all paths fell
  int searched = 0;         ///< frames: all, or those before it was stopped; the last option acts in the rest
};

/// Ties go to the better parent, then to the lower index.
/// @param clip  encoded for these options
/// @param should_stop  asked before every frame; may be empty
/// @throws std::invalid_argument without options, and for numbers out of range
Found search_roll_outs(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                       const rl::tracking::TrackingConfig& tracking,
                       const std::vector<const Option*>& options, const SearchConfig& config,
                       const std::function<bool()>& should_stop = {});

}  // namespace mimicx::pipeline::options
