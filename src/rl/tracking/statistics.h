/// What a roll-out of the tracking task was like: rewards, falls, and where episodes should start next.
#pragma once

#include <cstdint>

#include "core/containers.h"
#include "rl/tracking/reward.h"

namespace mimicx::rl::tracking {

/// What happened on the clips during one roll-out.
struct TrackingStatistics {
  Array<double, kRewardTerms> reward_terms{};  ///< sums over steps
  double reward = 0.0;                         ///< sum, of the unsoftened product
  double learned_reward = 0.0;                 ///< sum, of what the learner saw
  double saturated_joints = 0.0;               ///< sum
  std::int64_t steps = 0;
  List<List<std::int64_t>> falls, visits;  ///< [clip][bin] of the frame reached

  void clear();
  void add(const TrackingStatistics& other);
};

/// Probability of starting in each bin: a uniform share, and the rest in the bins that lead to falls. A fall
/// in bin b counts for starts in b and in the two bins before it.
/// @param fall_rates  [bin] share of the visits that end in a fall
List<double> start_weights(const List<double>& fall_rates, double uniform_share);

}  // namespace mimicx::rl::tracking
