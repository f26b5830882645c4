#include "rl/tracking/statistics.h"

#include <algorithm>
#include <numeric>

namespace mimicx::rl::tracking {

List<double> start_weights(const List<double>& fall_rates, const List<int>& frames, double uniform) {
  const int n = fall_rates.count();
  List<double> hard(fall_rates.size(), 0.0);
  for (int b = 0; b < n; ++b)
    for (int back = 0; back < 3 && back <= b; ++back)
      if (frames[b - back] > 0) hard[b - back] += fall_rates[b] * (0.5 - 0.15 * back);
  const double total = std::accumulate(hard.begin(), hard.end(), 0.0);
  const double all_frames = std::accumulate(frames.begin(), frames.end(), 0.0);
  List<double> weights(fall_rates.size());
  for (int b = 0; b < n; ++b) {
    const double even = frames[b] / all_frames;
    weights[b] = total > 0.0 ? uniform * even + (1.0 - uniform) * hard[b] / total : even;
  }
  return weights;
}

void TrackingStatistics::clear() {
  reward_terms.fill(0.0);
  reward = learned_reward = saturated_joints = 0.0;
  steps = 0;
  for (auto* table : {&falls, &visits})
    for (auto& row : *table) std::fill(row.begin(), row.end(), 0);
}

void TrackingStatistics::add(const TrackingStatistics& other) {
  for (int k = 0; k < kRewardTerms; ++k) reward_terms[k] += other.reward_terms[k];
  reward += other.reward;
  learned_reward += other.learned_reward;
  saturated_joints += other.saturated_joints;
  steps += other.steps;
  for (std::size_t c = 0; c < falls.size(); ++c)
    for (std::size_t b = 0; b < falls[c].size(); ++b) {
      falls[c][b] += other.falls[c][b];
      visits[c][b] += other.visits[c][b];
    }
}

}  // namespace mimicx::rl::tracking
