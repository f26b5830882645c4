/// The tracking task as an environment of the learner: groups of packs of characters, episodes, starts.
///
/// Episodes start anywhere on the clip (reference-state initialisation), more often before places where
/// characters fall. They terminate when a body is farther than `terminate_distance` from its reference, and
/// are truncated at the end of the clip (the learner bootstraps there).                docs/method.md §7
///
/// While a motion is hard to follow, the product of Eq. 2 is near zero and almost constant. The learner's
/// reward is therefore a power of the product, that is, all weights times one factor. The exponent falls
/// while the mean of the learner's rewards over an iteration is below `reward_target`, and returns to 1 as
/// that mean rises (docs/method.md §7, (2)).
///
/// Every pack of characters follows one clip. Unless the packs can be shared out evenly among the clips,
/// packs switch to the next clip in turn, so that all clips are used equally. Every start is drawn from a
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

/// @throws std::invalid_argument unless `characters` is a multiple of `group_size`, and that a multiple of
///    kLanes
void require_whole_groups(int characters, int group_size);

class TrackingEnvironment {
 public:
  /// @param characters  in all; a multiple of group_size
  /// @param group_size  a multiple of kLanes
  /// @param clips       of one state size
  /// @throws std::invalid_argument as `require_whole_groups`, and without clips
  TrackingEnvironment(std::vector<std::shared_ptr<const TrackingClip>> clips, const TrackingConfig& config,
                      int characters, int group_size, std::uint64_t seed);

  int groups() const { return static_cast<int>(groups_.size()); }
  int group_size() const { return group_size_; }
  int observation_dim() const { return clips_.front()->state_size(); }
  int action_dim() const { return kDofs; }
  /// Number of options: one more than the largest index in an arrangement.
  int agents() const;
  /// The option that acts for a character now, by its clip's arrangement.
  int actor(int group, int character) const;
  void observe(int group, Eigen::Ref<nn::Matrix<float>> observations) const;
  void step(int group, const Eigen::Ref<const nn::Matrix<float>>& actions, StepResult& result);
  /// @return the characters that switched to another clip
  std::vector<CharacterPlace> end_iteration();
  void save(Npz& archive, const std::string& prefix) const;
  /// @throws DataError if the archive is of other clips or numbers of characters
  void load(const Npz& archive, const std::string& prefix);

  /// Statistics of the roll-out before the last `end_iteration`.
  const TrackingStatistics& statistics() const { return last_; }
  /// [clip][bin] smoothed share of visits that end in a fall.
  const List<List<double>>& fall_rates() const { return fall_rates_; }
  /// Exponent of the learner's reward: 1, or less for a hard motion.
  double sharpness() const { return sharpness_; }

 private:
  struct Group {
    List<int> clips;  ///< [pack] index of its clip
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
  List<List<int>> start_frames_;  ///< [clip][bin] in which an episode can start
  List<List<double>> fall_rates_, start_weights_;
  std::int64_t iteration_ = 0;
  int next_clip_ = 0;  ///< clip of the next pack that switches
  double sharpness_ = 1.0;
  TrackingStatistics last_;
};

}  // namespace mimicx::rl::tracking
