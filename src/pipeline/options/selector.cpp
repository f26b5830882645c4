#include "pipeline/options/selector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mimicx::pipeline::options {
namespace {

/// Rejects inputs without an optimum: rows of different lengths, values that are not finite, a reward for
/// switching.
void require_usable(const OptionRewards& reward, double switch_penalty) {
  if (!(switch_penalty <= 0.0) || !std::isfinite(switch_penalty))
    throw std::invalid_argument("select_options: the switch penalty must be finite and at most 0");
  for (const auto& row : reward) {
    if (row.empty() || row.size() != reward.front().size())
      throw std::invalid_argument("select_options: every frame needs a reward of every option");
    if (!std::all_of(row.begin(), row.end(), [](double r) { return std::isfinite(r); }))
      throw std::invalid_argument("select_options: rewards must be finite");
  }
}

/// Index of the largest entry; of equal ones the first.
int best_of(const List<double>& values) {
  return static_cast<int>(std::max_element(values.begin(), values.end()) - values.begin());
}

}  // namespace

Arrangement select_options(const OptionRewards& reward, double switch_penalty) {
  require_usable(reward, switch_penalty);
  if (reward.empty()) return {};
  List<double> dp = reward.front();
  // from[t][c]: the option of frame t - 1 when c acts in frame t.
  List<List<int>> from(reward.size(), List<int>(dp.size()));
  for (int t = 1; t < reward.count(); ++t) {
    const int best = best_of(dp);
    const double switched = switch_penalty + dp[best];
    for (int c = 0; c < dp.count(); ++c) {
      const bool stay = dp[c] >= switched;
      from[t][c] = stay ? c : best;
      // dp[best] is changed in its own turn only, and `switched` holds the old one.
      dp[c] = reward[t][c] + (stay ? dp[c] : switched);
    }
  }
  Arrangement arrangement;
  int option = best_of(dp);
  arrangement.value = dp[option];
  arrangement.options.resize(reward.size());
  for (int t = reward.count() - 1; t >= 0; --t) {
    arrangement.options[t] = option;
    option = from[t][option];
  }
  return arrangement;
}

}  // namespace mimicx::pipeline::options
