#include "pipeline/options/side_by_side.h"

#include <algorithm>

#include "rl/tracking/rollout.h"

namespace mimicx::pipeline::options {
namespace {

/// Characters 0 … C − 1, kLanes to a pack.
struct Characters {
  List<rl::tracking::TrackingPack> packs;
  rl::tracking::TrackingPack& pack(int c) { return packs[c / physics::kLanes]; }
  static int lane(int c) { return c % physics::kLanes; }
};

/// Hands the best character's state to those that failed. @return false where all failed
bool rescue(Characters& characters, const List<double>& rewards, double threshold) {
  const auto best = static_cast<int>(std::max_element(rewards.begin(), rewards.end()) - rewards.begin());
  if (!(rewards[best] >= threshold)) return false;
  for (int c = 0; c < rewards.count(); ++c)
    if (!(rewards[c] >= threshold))
      characters.pack(c).copy_lane(Characters::lane(c), characters.pack(best), Characters::lane(best));
  return true;
}

}  // namespace

SideBySide roll_out_side_by_side(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                                 const rl::tracking::TrackingConfig& config,
                                 const std::vector<const Option*>& options, double threshold) {
  std::vector<rl::Agent> agents;
  for (const Option* option : options) agents.push_back(option->agent);
  const rl::tracking::MeanAction policy = rl::tracking::mean_action(agents);
  const int count = static_cast<int>(options.size());
  Characters characters;
  characters.packs.assign((options.size() + physics::kLanes - 1) / physics::kLanes,
                          rl::tracking::TrackingPack(clip, config));
  physics::Data<rl::tracking::TrackingPack::P> scratch;
  List<float> state(clip->state_size());
  Array<float, kDofs> action{};
  SideBySide result;
  result.rewards.emplace_back(options.size(), 1.0);
  for (int t = 1; t < clip->size(); ++t) {
    for (int c = 0; c < count; ++c) {
      rl::tracking::TrackingPack& pack = characters.pack(c);
      pack.observe(Characters::lane(c), c, state.data());
      policy(c, state.data(), action.data());
      pack.act(Characters::lane(c), action.data());
    }
    for (rl::tracking::TrackingPack& pack : characters.packs) pack.advance(scratch);
    List<double> rewards(options.size());
    for (int c = 0; c < count; ++c) {
      const rl::tracking::TrackingPack& pack = characters.pack(c);
      const bool fell = !(pack.worst_distance(Characters::lane(c)) <= config.terminate_distance);
      rewards[c] = fell ? 0.0 : pack.reward(Characters::lane(c)).total;
    }
    result.rewards.push_back(rewards);
    if (rescue(characters, rewards, threshold)) continue;
    result.breaks.push_back(t);
    for (int c = 0; c < count; ++c) characters.pack(c).reset(Characters::lane(c), t);
  }
  return result;
}

}  // namespace mimicx::pipeline::options
