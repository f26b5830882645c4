#include "pipeline/options/selector.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mimicx {
namespace {

/// What would give no optimum: unequal rows, values that are not finite, a premium on switching.
void require_usable(const std::vector<std::vector<double>>& reward, double switch_penalty) {
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
std::size_t best_of(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

}  // namespace

Arrangement select_options(const std::vector<std::vector<double>>& reward, double switch_penalty) {
  require_usable(reward, switch_penalty);
  if (reward.empty()) return {};
  const std::size_t frames = reward.size(), options = reward.front().size();
  std::vector<double> dp = reward.front();
  // from[t][c]: the option of frame t - 1 when c acts in frame t.
  std::vector<std::vector<std::size_t>> from(frames, std::vector<std::size_t>(options));
  for (std::size_t t = 1; t < frames; ++t) {
    const std::size_t best = best_of(dp);
    const double switched = switch_penalty + dp[best];
    for (std::size_t c = 0; c < options; ++c) {
      const bool stay = dp[c] >= switched;
      from[t][c] = stay ? c : best;
      // dp[best] is changed in its own turn only, and `switched` holds the old one.
      dp[c] = reward[t][c] + (stay ? dp[c] : switched);
    }
  }
  Arrangement arrangement;
  std::size_t option = best_of(dp);
  arrangement.value = dp[option];
  arrangement.options.resize(frames);
  for (std::size_t t = frames; t-- > 0; option = from[t][option])
    arrangement.options[t] = static_cast<int>(option);
  return arrangement;
}

}  // namespace mimicx
