#include "pipeline/options/arrangement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pipeline/options/selector.h"
#include "pipeline/options/side_by_side.h"

namespace mimicx::pipeline::options {
namespace {

/// The numbers that occur, ascending, each once.
std::vector<int> distinct(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

}  // namespace

void check(const ArrangementConfig& config) {
  if (!(config.switch_penalty <= 0.0) || !std::isfinite(config.switch_penalty))
    throw std::invalid_argument("the switch penalty must be finite and at most 0");
  if (!(config.rescue_reward >= 0.0 && config.rescue_reward <= 1.0))
    throw std::invalid_argument("the rescue reward must be 0 to 1, as rewards are");
}

ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config) {
  check(config);
  List<const Option*> all;
  for (const TrainedOption& trained : set.options) all.push_back(&trained.option);
  const SideBySide side_by_side =
      roll_out_side_by_side(encoded_for(clip, all), tracking, all, config.rescue_reward);
  ArrangedClip arranged;
  arranged.breaks = side_by_side.breaks;

  // The option of frame t acts towards frame t + 1, where its reward is found. Nothing is left to do in the
  // last frame: it keeps the option of the frame before.
  const auto& rewards = side_by_side.rewards;
  arranged.options =
      select_options(OptionRewards(rewards.begin() + 1, rewards.end()), config.switch_penalty).options;
  arranged.options.push_back(arranged.options.back());

  arranged.kept = distinct(arranged.options);
  std::vector<const Option*> kept;
  for (const int option : arranged.kept) {
    kept.push_back(all[option]);
    arranged.agents.push_back(kept.back()->agent);
  }
  auto seen = std::make_shared<rl::tracking::TrackingClip>(*encoded_for(clip, kept));
  for (const int option : arranged.options) {
    const auto place = std::lower_bound(arranged.kept.begin(), arranged.kept.end(), option);
    seen->arrangement.push_back(static_cast<int>(place - arranged.kept.begin()));
  }
  arranged.clip = seen;
  return arranged;
}

std::vector<std::array<int, 2>> stretches_of(const std::vector<int>& options) {
  std::vector<std::array<int, 2>> stretches;
  int frame = 0;
  for (const int option : options) {
    if (stretches.empty() || stretches.back()[1] != option) stretches.push_back({frame, option});
    ++frame;
  }
  return stretches;
}

}  // namespace mimicx::pipeline::options
