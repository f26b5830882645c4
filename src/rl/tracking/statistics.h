/// Statistics of a roll-out of the tracking task: rewards, falls, and weights of the next episode starts.
#pragma once

#include <cstdint>

#include "core/containers.h"
#include "rl/tracking/reward.h"

namespace mimicx::rl::tracking {

/// Sums over one roll-out.
struct TrackingStatistics {
  Array<double, kRewardTerms> reward_terms{};  ///< sums over steps
  double reward = 0.0;                         ///< sum of the rewards before softening
  double learned_reward = 0.0;                 ///< sum of the learner's rewards
  double saturated_joints = 0.0;               ///< sum
  std::int64_t steps = 0;
  List<List<std::int64_t>> falls, visits;  ///< [clip][bin] of the frame reached

  void clear();
  void add(const TrackingStatistics& other);
};

/// Probability of starting in each bin: a share that makes all frames equally likely, and the rest in bins
/// before falls. A fall in bin b counts for starts in b and in the two previous bins.
/// @param fall_rates  [bin] share of visits that end in a fall
/// @param frames      [bin] in which an episode can start; not all 0
List<double> start_weights(const List<double>& fall_rates, const List<int>& frames, double uniform_share);

}  // namespace mimicx::rl::tracking
