/// Which options of a set act in which frames of a motion, and the clip made ready for them.
///                                                                          docs/method.md §8, §9
/// A selector names the option of every frame:
///
///     dp       the options run side by side (option_rewards.h), rescues are paid for, and the arrangement of
///              the largest total reward is taken (selector.h): the paper's
///     beam     a search over real roll-outs (beam_search.h)
///     single   the option that does best when it acts alone from the first frame to the last
///     nearest  the option whose cluster's centre is nearest to the motion's features; nothing is simulated
///
/// The options that occur are kept, in the order of the set, and numbered anew from 0: joint fine-tuning
/// trains the policies that act and no others.
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
  double rescue_reward = 0.0;   ///< dp: σ; a character of less reward is put into the best one's state
  Selector selector = Selector::kDp;
  int rescue_frames = 0;  ///< dp: N, frames over which a reward fades towards a rescue; 0: rescues are free
  int beam_width = 1;     ///< beam: states that are kept
  int beam_stretch = 1;   ///< beam: frames for which an option acts at least
  int beam_retries = 0;   ///< beam: wider attempts where every path has fallen
};

/// @throws std::invalid_argument unless the penalty is finite and at most 0, σ in [0, 1], the selector one
/// of those above, N at least 0, the beam's width and stretch at least 1, and its retries 0 to 5
void check(const ArrangementConfig& config);

struct ArrangedClip {
  List<int> options;       ///< [frames] the option that acts, its number in the set
  List<int> breaks;        ///< frames at which nothing that was tried could follow
  int searched = 0;        ///< frames before the selector was told to stop; else all but the last
  List<int> kept;          ///< numbers in the set of the options that occur, ascending
  List<rl::Agent> agents;  ///< of the kept options
  std::shared_ptr<const rl::tracking::TrackingClip>
      clip;  ///< as the kept options see it, with their arrangement
};

/// @param clip  as `make_tracking_clip` gives it: not encoded, without an arrangement
/// @param should_stop  ends a search (beam, single) where it is: the option found last acts on; may be empty
/// @throws std::invalid_argument as `check`
/// @throws DataError for `nearest` and a clip of fewer than 3 frames
ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config, const std::function<bool()>& should_stop = {});

/// {first frame, option} of every stretch of frames in which one option acts.
std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options);

}  // namespace mimicx::pipeline::options
