/// Which options of a set act in which frames of a motion, and the clip made ready for them.
///                                                                          docs/method.md §8, §9
/// A selector names the option of every frame:
///
///     dp the options run side by side (option_rewards.h), rescues are charged, and the arrangement of the
///     largest total reward is taken (selector.h): the paper's beam     a beam search over real roll-outs
///     (beam_search.h) single   the option of the largest reward when it acts alone over the whole clip
///     nearest  the option whose cluster's centre is nearest to the motion's features; nothing is simulated
///
/// Only the options that act are kept, in the order of the set, and renumbered from 0: joint fine-tuning
/// trains these policies and no others.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "pipeline/options/option_set.h"

namespace mimicx::pipeline::options {

enum class Selector { kDp, kBeam, kSingle, kNearest };

struct ArrangementConfig {
  double switch_penalty = 0.0;  ///< w_p of Eq. 4, in rewards; ≤ 0
  double rescue_reward = 0.0;   ///< dp: σ; a character of smaller reward is put into the best one's state
  Selector selector = Selector::kDp;
  int rescue_frames =
      0;  ///< dp: N, frames before a rescue over which the reward fades to 0; 0: rescues cost nothing
  int beam_width = 1;    ///< beam: states that are kept
  int beam_stretch = 1;  ///< beam: shortest stretch of one option, frames
  int beam_retries = 0;  ///< beam: wider retries where every path has fallen
};

/// @throws std::invalid_argument unless the penalty is finite and at most 0, σ in [0, 1], the selector one
/// of those above, N at least 0, the beam's width and stretch at least 1, and its retries 0 to 5
void check(const ArrangementConfig& config);

struct ArrangedClip {
  List<int> options;       ///< [frames] index in the set of the option that acts
  List<int> breaks;        ///< frames at which no tried option followed
  int searched = 0;        ///< frames that the search reached before it was stopped; else all but the last
  List<int> kept;          ///< indices in the set of the options that act, ascending
  List<rl::Agent> agents;  ///< of the kept options
  std::shared_ptr<const rl::tracking::TrackingClip>
      clip;  ///< as the kept options see it, with their arrangement
};

/// @param clip  as `make_tracking_clip` gives it: not encoded, without an arrangement
/// @param should_stop  stops a search (beam, single): the last option found acts in all later frames; may be
/// empty
/// @throws std::invalid_argument as `check`
/// @throws DataError for `nearest` and a clip of fewer than 3 frames
ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config, const std::function<bool()>& should_stop = {});

/// {first frame, option} of every stretch of frames in which one option acts.
std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options);

}  // namespace mimicx::pipeline::options
