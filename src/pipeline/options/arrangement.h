/// Which options of a set act in which frames of a motion, and the clip made ready for them.
///                                                                          docs/method.md §8, §9
/// A selector names the option of every frame:
///
///   - dp: the options run side by side (option_rewards.h), rescues are charged, and the arrangement of the
///     largest total reward is taken (selector.h): the paper's if rescues are free and by the reward alone;
///   - beam: a beam search over real roll-outs (beam_search.h);
///   - single: the option of the largest reward when it acts alone over the whole clip;
///   - nearest: the option whose cluster's centre is nearest to the motion's features; nothing is simulated.
///
/// Only the options that act are kept, in the order of the set, and renumbered from 0: joint fine-tuning
/// trains these policies and no others.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "pipeline/options/option_rewards.h"
#include "pipeline/options/option_set.h"

namespace mimicx::pipeline::options {

enum class Selector { kDp, kBeam, kSingle, kNearest };

/// The defaults are those of `mimicx adapt`.
struct ArrangementConfig {
  double switch_penalty = -1.0;  ///< w_p of Eq. 4, in rewards; ≤ 0
  RescueBounds rescue = {};      ///< dp: what puts a character into the best one's state
  Selector selector = Selector::kBeam;
  int rescue_frames = 30;  ///< dp: N, frames over which a reward fades towards a rescue; 0: rescues are free
  int beam_width = 64;     ///< beam: states that are kept
  int beam_stretch = 10;   ///< beam: frames for which an option acts at least
  int beam_retries = 2;    ///< beam: wider attempts where every path has fallen
};

/// core/setting.h.
void visit_settings(ArrangementConfig& a, const auto& visit) {
  visit("switch_penalty", a.switch_penalty, -1e9, 0, "penalty on a change of option (Eq. 4), in rewards");
  visit("rescue_reward", a.rescue.reward, 0, 1, "dp: reward below which a character is rescued");
  visit("rescue_distance", a.rescue.distance, 0, 1e9,
        "dp: distance of a body from its reference beyond which a character is rescued, m");
  visit("rescue_frames", a.rescue_frames, 0, 1e9, "dp: frames over which rewards fade towards a rescue");
  visit("beam_width", a.beam_width, 1, 1e9, "beam: states kept per step");
  visit("beam_stretch", a.beam_stretch, 1, 1e9, "beam: frames for which an option acts at least");
  visit("beam_retries", a.beam_retries, 0, 5, "beam: wider attempts after every path has fallen");
  visit("selector", a.selector, 0, 3, "which option acts when: 0 dp, 1 beam, 2 single, 3 nearest");
}

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
/// @param should_stop  ends a search (beam, single) where it is: the option found last acts on; may be empty
/// @throws std::invalid_argument as `require_ranges` (core/setting.h)
/// @throws DataError for `nearest` and a clip of fewer than 3 frames
ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config, const std::function<bool()>& should_stop = {});

/// {first frame, option} of every stretch of frames in which one option acts.
std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options);

}  // namespace mimicx::pipeline::options
