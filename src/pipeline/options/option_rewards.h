/// C characters on one clip, one per option: the rewards from which the selector chooses.
///                                                                          docs/method.md §8
///
/// All act at once, each by the mean action of its option. Where a character's reward falls under σ, or it
/// has fallen, it is *rescued*: it takes over the state of the best character at that moment; where all of
/// them have, all restart from the reference at that frame and the break is recorded.
///
/// A rescue is no merit of the option that needed it. `charge_rescues` takes its reward, and lets those of
/// the N frames before it fade away:
///
///     r'[t][c] = r[t][c] · min(1, k / N)
///
/// where k is the number of frames from t to the next rescue of option c, 0 in the frame of the rescue
/// itself.
#pragma once

#include "pipeline/options/option.h"
#include "pipeline/options/selector.h"

namespace mimicx::pipeline::options {

struct SideBySide {
  /// [frame][option] of the pose reached at the frame, before any rescue; frame 0 is the start, with
  /// reward 1.
  OptionRewards rewards;
  List<List<bool>> rescued;  ///< [frame][option] whether the option had failed at the frame
  std::vector<int> breaks;   ///< frames at which all options had failed
};

/// @param clip       encoded for these options
/// @param threshold  σ
SideBySide roll_out_side_by_side(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const rl::tracking::TrackingConfig& config,
                                 const std::vector<const Option*>& options, double threshold);

/// r' as above. @param frames  N; 0: rescues cost nothing
OptionRewards charge_rescues(const SideBySide& rolled, int frames);

}  // namespace mimicx::pipeline::options
