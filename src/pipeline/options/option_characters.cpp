#include "pipeline/options/option_characters.h"

namespace mimicx::pipeline::options {

Characters::Characters(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
                       const rl::tracking::TrackingConfig& config, int count)
    : state_(static_cast<std::size_t>(clip->state_size())),
      scratch_(std::make_unique<physics::Data<Pack::P>>()) {
  const int packs = (count + physics::kLanes - 1) / physics::kLanes;
  packs_.assign(static_cast<std::size_t>(packs), Pack(clip, config));
}

void Characters::advance(const rl::tracking::MeanAction& policy, const List<int>& options) {
  Array<float, kDofs> action{};
  for (int c = 0; c < options.count(); ++c) {
    pack(c).observe(lane(c), options[c], state_.data());
    policy(options[c], state_.data(), action.data());
    pack(c).act(lane(c), action.data());
  }
  for (Pack& pack : packs_) pack.advance(*scratch_);
}

void Characters::copy(int c, const Characters& from, int other) {
  pack(c).copy_lane(lane(c), from.pack(other), lane(other));
}

void Characters::reset(int c, int frame) { pack(c).reset(lane(c), frame); }

rl::tracking::MeanAction mean_action_of(const std::vector<const Option*>& options) {
  std::vector<rl::Agent> agents;
  for (const Option* option : options) agents.push_back(option->agent);
  return rl::tracking::mean_action(agents);
}

}  // namespace mimicx::pipeline::options
