/// Which option acts in which frame, found by trying: a beam search over real roll-outs.   docs/method.md §8
///
/// Side by side, every option has its own character, and what an option earns says little about what happens
/// to a character that another option has brought there. Here characters are handed over as they will be:
/// from each of the best states so far every option acts for a stretch of frames, and the best of the states
/// that this leads to go on. Paths are compared by Eq. 4 with the rewards that were really earned; one that
/// has fallen is dropped. Where all have, the search goes back some stretches and tries again with more
/// states and stretches of half the length, until it has passed the place; the next time it goes back farther
/// with more of them. Where no retry is left, the best path restarts from the reference, and the break is
/// recorded.
///
/// With one stretch as long as the clip this is the best single option.
///
/// What it does not do: it keeps no promise to find the best arrangement, unless the beam is as wide as there
/// are paths; and options change at the ends of stretches only.
#pragma once

#include <functional>

#include "pipeline/options/option.h"

namespace mimicx::pipeline::options {

struct SearchConfig {
  int width = 1;                ///< states that are kept, ≥ 1
  int stretch = 1;              ///< frames for which an option acts at least, ≥ 1
  double switch_penalty = 0.0;  ///< w_p of Eq. 4, ≤ 0
  int retries = 0;              ///< wider attempts where every path has fallen, ≥ 0
};

struct Found {
  List<int> options;        ///< [frames − 1] the option that acts towards the next frame
  double value = 0.0;       ///< R of Eq. 4
  std::vector<int> breaks;  ///< frames at which every path had fallen
  int searched = 0;  ///< frames: all, or as far as it was when told to stop; then the last option acts on
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
