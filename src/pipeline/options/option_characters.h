/// Simulated characters on one clip, each driven by an option of its own choice.       docs/method.md §8
#pragma once

#include <memory>
#include <vector>

#include "core/containers.h"
#include "pipeline/options/option.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {

/// Characters 0 … count − 1, kLanes to a pack. Characters do not influence each other.
class Characters {
 public:
  /// All start in the reference's state at frame 0.
  Characters(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
             const rl::tracking::TrackingConfig& config, int count);

  /// Advances all by one frame, each with the mean action of its option. @param options  [count]
  void advance(const rl::tracking::MeanAction& policy, const List<int>& options);
  /// The reward of Eqs. 2 and 3 at the frame reached.
  double reward(int c) const { return pack(c).reward(lane(c)).total; }
  /// Whether a body is farther than this from its reference, m, or the simulation failed.
  bool fell(int c, double distance) const { return !(pack(c).worst_distance(lane(c)) <= distance); }
  /// Puts character c into the state of a character of `from`, which is on the same clip.
  void copy(int c, const Characters& from, int other);
  /// Puts character c into the reference's state.
  void reset(int c, int frame);

 private:
  using Pack = rl::tracking::TrackingPack;
  Pack& pack(int c) { return packs_[c / physics::kLanes]; }
  const Pack& pack(int c) const { return packs_[c / physics::kLanes]; }
  static int lane(int c) { return c % physics::kLanes; }

  List<Pack> packs_;
  std::vector<float> state_;  ///< [state_size] of the character that acts next
  std::unique_ptr<physics::Data<Pack::P>> scratch_;
};

/// Mean actions by number, of all options.
rl::tracking::MeanAction mean_action_of(const std::vector<const Option*>& options);

}  // namespace mimicx::pipeline::options
