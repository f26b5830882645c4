#include "pipeline/options/option_rewards.h"

#include <algorithm>

#include "pipeline/options/option_characters.h"

namespace mimicx::pipeline::options {

SideBySide roll_out_side_by_side(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const rl::tracking::TrackingConfig& config,
                                 const std::vector<const Option*>& options, const RescueBounds& bounds) {
  const rl::tracking::MeanAction policy = mean_action_of(options);
  const int count = static_cast<int>(options.size());
  List<int> own;  // character c acts by option c
  for (int c = 0; c < count; ++c) own.push_back(c);
  Characters characters(clip, config, count);
  SideBySide result;
  result.rewards.emplace_back(options.size(), 1.0);
  result.rescued.emplace_back(options.size(), false);
  for (int t = 1; t < clip->size(); ++t) {
    characters.advance(policy, own);
    List<double> rewards;
    List<bool> failed;
    for (int c = 0; c < count; ++c) {
      const bool fell = characters.fell(c, bounds.distance);
      rewards.push_back(fell ? 0.0 : characters.reward(c));
      failed.push_back(fell || !(rewards[c] >= bounds.reward));
    }
    const auto best = static_cast<int>(std::max_element(rewards.begin(), rewards.end()) - rewards.begin());
    if (failed[best]) result.breaks.push_back(t);
    for (int c = 0; c < count; ++c) {
      if (failed[best])
        characters.reset(c, t);
      else if (failed[c])
        characters.copy(c, characters, best);
    }
    result.rewards.push_back(rewards);
    result.rescued.push_back(failed);
  }
  return result;
}

OptionRewards charge_rescues(const SideBySide& rolled, int frames) {
  OptionRewards charged = rolled.rewards;
  if (frames == 0) return charged;
  List<int> to_rescue(charged.empty() ? 0 : charged.front().size(), frames);  // k, at most `frames`
  for (int t = charged.count() - 1; t >= 0; --t)
    for (int c = 0; c < to_rescue.count(); ++c) {
      to_rescue[c] = rolled.rescued[t][c] ? 0 : std::min(to_rescue[c] + 1, frames);
      charged[t][c] *= static_cast<double>(to_rescue[c]) / frames;
    }
  return charged;
}

}  // namespace mimicx::pipeline::options
