#include "pipeline/options/arrangement.h"

#include <algorithm>

#include "core/setting.h"
#include "pipeline/options/beam_search.h"
#include "pipeline/options/clusters.h"
#include "pipeline/options/option_rewards.h"
#include "pipeline/options/selector.h"

namespace mimicx::pipeline::options {
namespace {

/// The distinct numbers, ascending.
std::vector<int> distinct(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// The option that acts in frame t, towards frame t + 1, at which its reward is taken. [frames − 1]
struct Choice {
  List<int> options;
  std::vector<int> breaks;
  int searched;  ///< frames
};

Choice choose_by_programme(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                           const rl::tracking::TrackingConfig& tracking,
                           const std::vector<const Option*>& options, const ArrangementConfig& config) {
  const SideBySide rolled = roll_out_side_by_side(clip, tracking, options, config.rescue);
  const OptionRewards rewards = charge_rescues(rolled, config.rescue_frames);
  return {select_options(OptionRewards(rewards.begin() + 1, rewards.end()), config.switch_penalty).options,
          rolled.breaks, clip->size() - 1};
}

Choice choose_by_search(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                        const rl::tracking::TrackingConfig& tracking,
                        const std::vector<const Option*>& options, const SearchConfig& config,
                        const std::function<bool()>& should_stop) {
  Found found = search_roll_outs(clip, tracking, options, config, should_stop);
  return {std::move(found.options), std::move(found.breaks), found.searched};
}

int nearest_option(const OptionSet& set, const motion::Reference& reference) {
  Clusters clusters;
  for (const TrainedOption& trained : set.options) {
    clusters.clusters.emplace_back();
    clusters.clusters.back().centre = trained.centre;
  }
  return nearest_cluster(clusters, motion_features(reference));
}

Choice choose(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
              const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
              const std::vector<const Option*>& options, const ArrangementConfig& config,
              const std::function<bool()>& should_stop) {
  const int acting = clip->size() - 1;
  if (config.selector == Selector::kNearest)
    return {List<int>(acting, nearest_option(set, clip->reference)), {}, acting};
  const auto encoded = encoded_for(clip, options);
  if (config.selector == Selector::kDp) return choose_by_programme(encoded, tracking, options, config);
  const bool single = config.selector == Selector::kSingle;
  return choose_by_search(encoded, tracking, options,
                          single ? SearchConfig{1, acting, config.switch_penalty}
                                 : SearchConfig{config.beam_width, config.beam_stretch, config.switch_penalty,
                                                config.beam_retries},
                          should_stop);
}

}  // namespace

ArrangedClip arrange(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                     const rl::tracking::TrackingConfig& tracking, const OptionSet& set,
                     const ArrangementConfig& config, const std::function<bool()>& should_stop) {
  require_ranges(config);
  List<const Option*> all;
  for (const TrainedOption& trained : set.options) all.push_back(&trained.option);
  Choice choice = choose(clip, tracking, set, all, config, should_stop);
  ArrangedClip arranged;
  arranged.searched = choice.searched;
  arranged.breaks = std::move(choice.breaks);
  arranged.options = std::move(choice.options);
  // No option acts in the last frame: it keeps the option of the frame before.
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
