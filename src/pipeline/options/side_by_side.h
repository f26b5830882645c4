/// C characters on one clip, one per option: the rewards from which the selector chooses.
///                                                                          docs/method.md §8
///
/// All act at once, each by the mean action of its option. Where a character's reward falls under σ, or it
/// has fallen, it takes over the state of the best character at that moment; where all of them have, all
/// restart from the reference at that frame and the break is recorded.
#pragma once

#include "pipeline/options/option.h"
#include "pipeline/options/selector.h"

namespace mimicx::pipeline::options {

struct SideBySide {
  /// [frame][option] of the pose reached at the frame, before any reset; frame 0 is the start, with reward 1.
  OptionRewards rewards;
  std::vector<int> breaks;  ///< frames at which all options had failed
};

/// @param clip       encoded for these options
/// @param threshold  σ
SideBySide roll_out_side_by_side(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const rl::tracking::TrackingConfig& config,
                                 const std::vector<const Option*>& options, double threshold);

}  // namespace mimicx::pipeline::options
