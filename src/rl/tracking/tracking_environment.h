/// The tracking task as the learner's environment: packs of characters in groups, episodes, starts.
///
/// Episodes start anywhere on the clip (reference-state initialisation), more often where characters fall.
/// They end early when a body is farther than `terminate_distance` from its reference (a true end), and at
/// the end of the clip (a time limit: the learner bootstraps there).                docs/method.md §7
///
/// The product of Eq. 2 stays near zero while a motion is hard to follow, and teaches little there. The
/// learner's reward is therefore the product to a power, that is, all weights times one factor. The power
/// falls while the mean reward stays under `reward_target` and returns to 1 as the motion is mastered
/// (docs/method.md §7).
///
/// Every pack of characters follows one clip. Where there are more clips than packs, packs move on to the
/// next clip in turn, one after the other, so that all clips have their share. Every start is drawn from a
/// stream keyed by seed, character and episode.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rl/environment.h"
#include "rl/tracking/statistics.h"
#include "rl/tracking/tracking_pack.h"

namespace mimicx::rl::tracking {

/// @throws std::invalid_argument unless the characters fill whole groups, and a group whole packs of lanes
void require_whole_groups(int characters, int group_size);

class TrackingEnvironment {
 public:
  /// @param characters  in all; a multiple of group_size
  /// @param group_size  a multiple of kLanes
  /// @param clips       of one state size
  /// @throws std::invalid_argument for sizes that do not fit, or no clips
  TrackingEnvironment(std::vector<std::shared_ptr<const TrackingClip>> clips, const TrackingConfig& config,
                      int characters, int group_size, std::uint64_t seed);

  int groups() const { return static_cast<int>(groups_.size()); }
  int group_size() const { return group_size_; }
  int observation_dim() const { return clips_.front()->state_size(); }
  int action_dim() const { return kDofs; }
  /// One more than the largest number that an arrangement names.
  int agents() const;
  /// The option that acts for a character now: that of its clip's arrangement.
  int actor(int group, int character) const;
  void observe(int group, Eigen::Ref<nn::Matrix<float>> observations) const;
  void step(int group, const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result);
  /// @return the characters that have moved on to another clip
  std::vector<CharacterPlace> end_iteration();
  void save(Npz& archive, const std::string& prefix) const;
  /// @throws DataError where the archive is of other clips or numbers of characters
  void load(const Npz& archive, const std::string& prefix);

  /// Of the roll-out that `end_iteration` has just closed.
  const TrackingStatistics& statistics() const { return last_; }
  /// Smoothed share of the visits to a bin that end in a fall. [clip][bin]
  const List<List<double>>& fall_rates() const { return fall_rates_; }
  /// Power of the product that the learner is given: 1, or less where the motion is hard.
  double sharpness() const { return sharpness_; }

 private:
  struct Group {
    List<int> clips;  ///< [pack] which clip it follows
    List<TrackingPack> packs;
    List<std::int64_t> episodes;  ///< [group_size] episodes begun
    std::unique_ptr<physics::Data<TrackingPack::P>> scratch;
    TrackingStatistics statistics;
  };
  int draw_start(int clip, int group, int character, std::int64_t episode) const;
  void restart(int group, int character);
  void follow_next_clip(int group, int pack);
  std::vector<CharacterPlace> move_on();

  List<std::shared_ptr<const TrackingClip>> clips_;
  TrackingConfig config_;
  int group_size_;
  std::uint64_t seed_;
  List<Group> groups_;
  List<List<double>> fall_rates_, start_weights_;
  std::int64_t iteration_ = 0;
  int next_clip_ = 0;  ///< where the next pack moves on to
  double sharpness_ = 1.0;
  TrackingStatistics last_;
};

}  // namespace mimicx::rl::tracking
