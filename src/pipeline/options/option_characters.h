/// Simulated characters on one clip, each driven by an option of its own choice.       docs/method.md §8
#pragma once

#include <memory>
#include <vector>

#include "core/containers.h"
#include "pipeline/options/option.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::pipeline::options {

/// Characters 0 … count − 1, kLanes to a pack. What one does depends on no other.
class Characters {
 public:
  /// All stand on frame 0 of the clip.
  Characters(const std::shared_ptr<const rl::tracking::TrackingClip>& clip,
             const rl::tracking::TrackingConfig& config, int count);

  /// One frame of all: each acts by the mean action of its option. @param options  [count]
  void advance(const rl::tracking::MeanAction& policy, const List<int>& options);
  /// Of the frame reached: the reward of Eq. 2, 0 where `fell`.
  double reward(int c) const;
  /// A body is farther than `terminate_distance` from its reference, or the simulation went wrong.
  bool fell(int c) const;
  /// Puts character c into the state of another one, of these or of others on the same clip.
  void copy(int c, const Characters& from, int other);
  /// Puts character c on the reference.
  void reset(int c, int frame);

 private:
  using Pack = rl::tracking::TrackingPack;
  Pack& pack(int c) { return packs_[c / physics::kLanes]; }
  const Pack& pack(int c) const { return packs_[c / physics::kLanes]; }
  static int lane(int c) { return c % physics::kLanes; }

  double terminate_distance_;
  List<Pack> packs_;
  std::vector<float> state_;  ///< [state_size] of the character that is to act
  std::unique_ptr<physics::Data<Pack::P>> scratch_;
};

/// Mean actions by number, of all options.
rl::tracking::MeanAction mean_action_of(const std::vector<const Option*>& options);

}  // namespace mimicx::pipeline::options
