#include "rl/tracking/tracking_environment.h"

#include <algorithm>
#include <stdexcept>

#include "core/elementary.h"
#include "core/error.h"
#include "core/number_text.h"
#include "core/random.h"
#include "nn/checkpoint.h"

namespace mimicx::rl::tracking {
namespace {

constexpr std::uint64_t kStartStream = 0x7374617274;  // "start"
constexpr double kFallRateMemory = 0.8;               // share of the old estimate kept per iteration
constexpr std::int64_t kClipIterations = 16;          // iterations before a pack switches its clip
constexpr double kSharpnessStep = 1.01;               // factor per iteration

/// [bin] frames in which an episode can start: all but the last one, so that it has a step.
List<int> start_frames(const TrackingClip& clip, const TrackingConfig& config) {
  List<int> frames;
  for (int first = 0; first < clip.size(); first += config.bin_frames)
    frames.push_back(std::min(clip.size() - 1 - first, config.bin_frames));
  return frames;
}

}  // namespace

void require_whole_groups(int characters, int group_size) {
  if (group_size < physics::kLanes || group_size % physics::kLanes != 0 || characters < group_size ||
      characters % group_size != 0)
    throw std::invalid_argument("characters must be a multiple of group_size, and that of " +
                                std::to_string(physics::kLanes) + ", the lanes of this build");
}

TrackingEnvironment::TrackingEnvironment(std::vector<std::shared_ptr<const TrackingClip>> clips,
                                         const TrackingConfig& config, int characters, int group_size,
                                         std::uint64_t seed)
    : clips_(std::move(clips)), config_(config), group_size_(group_size), seed_(seed) {
  if (clips_.empty()) throw std::invalid_argument("TrackingEnvironment: no clips");
  require_whole_groups(characters, group_size);
  for (const auto& clip : clips_) {
    start_frames_.push_back(start_frames(*clip, config_));
    const int bins = start_frames_.back().count();
    last_.falls.emplace_back(bins, 0);
    last_.visits.emplace_back(bins, 0);
    fall_rates_.emplace_back(bins, 0.0);
    start_weights_.push_back(start_weights(fall_rates_.back(), start_frames_.back(), config_.uniform_starts));
  }
  groups_.resize(characters / group_size);
  for (int g = 0; g < groups_.count(); ++g) {
    Group& group = groups_[g];
    const int packs = group_size / physics::kLanes;
    group.clips.assign(packs, 0);
    group.packs.assign(packs, TrackingPack(clips_.front(), config_));
    group.episodes.assign(group_size, 0);
    group.scratch = std::make_unique<physics::Data<TrackingPack::P>>();
    group.statistics = last_;
    for (int p = 0; p < group.packs.count(); ++p) follow_next_clip(g, p);
  }
}

int TrackingEnvironment::agents() const {
  int last = 0;
  for (const auto& clip : clips_)
    for (const int option : clip->arrangement) last = std::max(last, option);
  return last + 1;
}

/// Switches a pack to the next clip in turn; every lane draws its own start.
void TrackingEnvironment::follow_next_clip(int g, int p) {
  Group& group = groups_[g];
  group.clips[p] = next_clip_;
  group.packs[p] = TrackingPack(clips_[next_clip_], config_);
  for (int lane = 0; lane < physics::kLanes; ++lane) restart(g, p * physics::kLanes + lane);
  next_clip_ = (next_clip_ + 1) % clips_.count();
}

/// Switches the packs that are due to their next clips, unless all clips have equally many packs.
/// @return the characters of these packs
std::vector<CharacterPlace> TrackingEnvironment::move_on() {
  std::vector<CharacterPlace> moved;
  const int per_group = groups_.front().packs.count();
  if (groups_.count() * per_group % clips_.count() == 0) return moved;
  for (int g = 0; g < groups_.count(); ++g)
    for (int p = 0; p < per_group; ++p) {
      const int turn = g * per_group + p;
      if ((iteration_ + turn) % kClipIterations != 0) continue;
      follow_next_clip(g, p);
      for (int lane = 0; lane < physics::kLanes; ++lane) moved.push_back({g, p * physics::kLanes + lane});
    }
  return moved;
}

int TrackingEnvironment::draw_start(int clip, int group, int character, std::int64_t episode) const {
  Random random(seed_, {kStartStream, static_cast<std::uint64_t>(group),
                        static_cast<std::uint64_t>(character), static_cast<std::uint64_t>(episode)});
  const List<double>& weights = start_weights_[clip];
  const List<int>& frames = start_frames_[clip];
  double draw = random.uniform();
  int bin = 0;
  while (bin + 1 < weights.count() && frames[bin + 1] > 0 && draw >= weights[bin]) draw -= weights[bin++];
  return bin * config_.bin_frames + static_cast<int>(random.below(static_cast<std::uint32_t>(frames[bin])));
}

void TrackingEnvironment::restart(int g, int character) {
  Group& group = groups_[g];
  const std::int64_t episode = group.episodes[character]++;
  const int pack = character / physics::kLanes;
  group.packs[pack].reset(character % physics::kLanes, draw_start(group.clips[pack], g, character, episode));
}

int TrackingEnvironment::actor(int g, int character) const {
  const TrackingPack& pack = groups_[g].packs[character / physics::kLanes];
  return pack.clip().option_at(pack.frame(character % physics::kLanes));
}

void TrackingEnvironment::observe(int g, Eigen::Ref<nn::Matrix<float>> observations) const {
  const Group& group = groups_[g];
  for (int n = 0; n < group_size_; ++n)
    group.packs[n / physics::kLanes].observe(n % physics::kLanes, observations.row(n).data());
}

void TrackingEnvironment::step(int g, const Eigen::Ref<const nn::Matrix<float>>& actions,
                               StepResult& result) {
  Group& group = groups_[g];
  TrackingStatistics& statistics = group.statistics;
  for (int n = 0; n < group_size_; ++n)
    group.packs[n / physics::kLanes].act(n % physics::kLanes, actions.row(n).data());
  for (TrackingPack& pack : group.packs) pack.advance(*group.scratch);
  for (int n = 0; n < group_size_; ++n) {
    const int p = n / physics::kLanes;
    TrackingPack& pack = group.packs[p];
    const int lane = n % physics::kLanes, frame = pack.frame(lane);
    const Reward reward = pack.reward(lane);
    const bool fell = !(pack.worst_distance(lane) <= config_.terminate_distance);
    const bool ended = frame >= pack.clip().size() - 1;
    const double learned = sharpness_ == 1.0 ? reward.total : pow(reward.total, sharpness_);
    result.reward[n] = static_cast<float>(learned);
    result.terminated[n] = fell;
    result.truncated[n] = ended && !fell;
    for (int k = 0; k < kRewardTerms; ++k) statistics.reward_terms[k] += reward.term[k];
    statistics.reward += reward.total;
    statistics.learned_reward += learned;
    statistics.saturated_joints += pack.saturated_joints(lane);
    ++statistics.steps;
    const int bin = frame / config_.bin_frames;
    ++statistics.visits[group.clips[p]][bin];
    if (fell) ++statistics.falls[group.clips[p]][bin];
    if (result.truncated[n]) {
      pack.observe(lane, result.final_observations.row(n).data());
      result.final_actors[n] = actor(g, n);
    }
    if (fell || ended) restart(g, n);
  }
}

std::vector<CharacterPlace> TrackingEnvironment::end_iteration() {
  last_.clear();
  for (Group& group : groups_) {
    last_.add(group.statistics);
    group.statistics.clear();
  }
  if (config_.reward_target > 0.0) {
    const bool mastered = last_.learned_reward >= config_.reward_target * static_cast<double>(last_.steps);
    sharpness_ = std::clamp(mastered ? sharpness_ * kSharpnessStep : sharpness_ / kSharpnessStep,
                            config_.softest_reward, 1.0);
  }
  for (int c = 0; c < clips_.count(); ++c) {
    for (int b = 0; b < fall_rates_[c].count(); ++b) {
      if (last_.visits[c][b] == 0) continue;
      const double rate = static_cast<double>(last_.falls[c][b]) / static_cast<double>(last_.visits[c][b]);
      fall_rates_[c][b] = kFallRateMemory * fall_rates_[c][b] + (1.0 - kFallRateMemory) * rate;
    }
    start_weights_[c] = start_weights(fall_rates_[c], start_frames_[c], config_.uniform_starts);
  }
  ++iteration_;
  return move_on();
}

void TrackingEnvironment::save(Npz& archive, const std::string& prefix) const {
  archive.set(prefix + "sharpness", NpyArray::scalar(sharpness_));
  archive.set(prefix + "iteration", NpyArray::scalar_int(iteration_));
  archive.set(prefix + "next_clip", NpyArray::scalar_int(next_clip_));
  for (int g = 0; g < groups_.count(); ++g) {
    const std::string key = prefix + "group" + std::to_string(g) + ".";
    const Group& group = groups_[g];
    for (int p = 0; p < group.packs.count(); ++p) {
      const std::vector<float> values = group.packs[p].save();
      archive.set(key + "pack" + std::to_string(p), NpyArray::from_float({values.size()}, values.data()));
    }
    const std::vector<std::int64_t> clips(group.clips.begin(), group.clips.end());
    archive.set(key + "clips", NpyArray::from_int64({clips.size()}, clips.data()));
    archive.set(key + "episodes", NpyArray::from_int64({group.episodes.size()}, group.episodes.data()));
  }
  for (int c = 0; c < clips_.count(); ++c)
    archive.set(prefix + "fall_rates" + std::to_string(c),
                NpyArray::from_double({fall_rates_[c].size()}, fall_rates_[c].data()));
}

void TrackingEnvironment::load(const Npz& archive, const std::string& prefix) {
  const auto clip_index = [&](double value) {
    if (!(value >= 0.0 && value < static_cast<double>(clips_.size())))
      throw DataError(archive.path, prefix, "one of " + std::to_string(clips_.size()) + " clips",
                      text_of(value));
    return static_cast<int>(value);
  };
  sharpness_ = number_at(archive, prefix + "sharpness");
  iteration_ = whole_number_at(archive, prefix + "iteration");
  next_clip_ = clip_index(number_at(archive, prefix + "next_clip"));
  for (int g = 0; g < groups_.count(); ++g) {
    const std::string key = prefix + "group" + std::to_string(g) + ".";
    Group& group = groups_[g];
    const List<double> clips = numbers_at(archive, key + "clips", group.packs.size());
    for (int p = 0; p < group.packs.count(); ++p) {
      group.clips[p] = clip_index(clips[p]);
      group.packs[p] = TrackingPack(clips_[group.clips[p]], config_);
      const std::string pack = key + "pack" + std::to_string(p);
      const std::vector<double> values = numbers_at(archive, pack, group.packs[p].save().size());
      try {
        group.packs[p].load(std::vector<float>(values.begin(), values.end()));
      } catch (const std::invalid_argument& error) {
        throw DataError(archive.path, pack, "a frame of the clip", error.what());
      }
    }
    group.episodes = nn::whole_numbers_at(archive, key + "episodes", group.episodes.size());
    group.statistics.clear();
  }
  for (int c = 0; c < clips_.count(); ++c) {
    fall_rates_[c] = numbers_at(archive, prefix + "fall_rates" + std::to_string(c), fall_rates_[c].size());
    start_weights_[c] = start_weights(fall_rates_[c], start_frames_[c], config_.uniform_starts);
  }
}

}  // namespace mimicx::rl::tracking
