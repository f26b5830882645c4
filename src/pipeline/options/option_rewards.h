/// The rewards for the selector: C characters on one clip, one per option.
///                                                                          docs/method.md §8
///
/// All act in parallel, each with the mean action of its option. A character whose reward is below σ is
/// *rescued*: it takes over the state of the best character at that frame. So is, not in the paper, one that
/// has fallen, a body farther than a given distance from its reference; its reward is 0. If all need a
/// rescue, all restart from the reference at that frame, and the break is recorded.
///
/// The option did not earn the state after a rescue. `charge_rescues` therefore sets the reward at the rescue
/// to 0 and fades out the rewards of the N frames before:
///
///     r'[t][c] = r[t][c] · min(1, k / N)
///
/// where k is the number of frames from t to the next rescue of option c, 0 in the frame of the rescue
/// itself.
#pragma once

#include "pipeline/options/option.h"
#include "pipeline/options/selector.h"

namespace mimicx::pipeline::options {

/// What calls for a rescue.
struct RescueBounds {
  double reward = 0.1;    ///< σ; less than this
  double distance = 0.4;  ///< of a body from its reference; more than this, m
};

struct SideBySide {
  /// [frame][option] of the pose reached at the frame, before any rescue; frame 0 is the start, with
  /// reward 1.
  OptionRewards rewards;
  List<List<bool>> rescued;  ///< [frame][option] whether the option had failed at the frame
  std::vector<int> breaks;   ///< frames at which all options had failed
};

/// @param clip  encoded for these options
SideBySide roll_out_side_by_side(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const rl::tracking::TrackingConfig& config,
                                 const std::vector<const Option*>& options, const RescueBounds& bounds);

/// r' as above. @param frames  N; 0: rescues cost nothing
OptionRewards charge_rescues(const SideBySide& rolled, int frames);

}  // namespace mimicx::pipeline::options
