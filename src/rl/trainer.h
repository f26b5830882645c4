/// The training loop: collect → advantages → update, for one agent in one environment.
///
/// Random numbers are keyed by what they are for: the noise of the actions by (seed, purpose, iteration,
/// group). `save` takes the complete state between two iterations; loading it into a trainer of the same
/// configuration and environment and going on gives the same bytes as never having stopped.
#pragma once

#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "rl/environment.h"
#include "rl/ppo.h"

namespace mimicx::rl {

template <Environment E>
class PpoTrainer {
 public:
  /// @param environment  referred to, must outlive the trainer
  PpoTrainer(const PpoConfig& config, Agent agent, E& environment)
      : config_(config),
        environment_(environment),
        learner_(make_learner(config, std::move(agent))),
        buffer_(make_rollout_buffer(environment.groups(), environment.group_size(), config.horizon,
                                    environment.observation_dim(), environment.action_dim())),
        collect_(static_cast<std::size_t>(environment.groups()),
                 CollectScratch(environment.group_size(), environment.observation_dim())),
        update_(config),
        rows_(static_cast<std::size_t>(buffer_.rows())) {
    std::iota(rows_.begin(), rows_.end(), 0);
  }

  /// One iteration. The result does not depend on the number of threads.
  IterationStats iterate(int threads) {
    IterationStats stats;
    stats.iteration = learner_.iteration;
    stats.sigma = exploration_sigma(config_, learner_.samples);

    collect(stats.sigma, threads);
    environment_.end_iteration();
    learner_.samples += buffer_.rows();
    stats.samples = learner_.samples;
    describe_rollout(buffer_, config_.mean_bound, stats);

    // Nothing is learned before the observations have a scale: what the networks saw would not match.
    if (learner_.agent.observations.moments.count > 0)
      update(learner_, config_, buffer_, rows_, stats.sigma, 0, threads, update_, stats);
    absorb_observations();
    ++learner_.iteration;
    return stats;
  }

  const Learner& learner() const { return learner_; }
  const RolloutBuffer& buffer() const { return buffer_; }

  void save(Npz& archive, const std::string& prefix) const {
    rl::save(archive, prefix + "learner.", learner_);
    std::vector<std::int64_t> ages;
    for (const GroupRollout& group : buffer_.groups)
      ages.insert(ages.end(), group.ages.begin(), group.ages.end());
    archive.set(prefix + "ages", NpyArray::from_int64({ages.size()}, ages.data()));
    environment_.save(archive, prefix + "environment.");
  }

  /// @throws DataError where the archive does not fit this trainer.
  void load(const Npz& archive, const std::string& prefix) {
    learner_ = load_learner(archive, prefix + "learner.");
    const std::vector<double> ages = archive.at(prefix + "ages").to_double();
    const auto size = static_cast<std::size_t>(buffer_.group_size);
    if (ages.size() != size * buffer_.groups.size())
      throw DataError(archive.path, prefix + "ages",
                      std::to_string(size * buffer_.groups.size()) + " characters",
                      std::to_string(ages.size()));
    for (std::size_t i = 0; i < ages.size(); ++i)
      buffer_.groups[i / size].ages[i % size] = static_cast<std::int64_t>(ages[i]);
    environment_.load(archive, prefix + "environment.");
  }

 private:
  void collect(double sigma, int threads) {
    parallel_for(static_cast<int>(buffer_.groups.size()), threads, [&](int group) {
      const auto index = static_cast<std::size_t>(group);
      const Random random(config_.seed, {kActionNoise, static_cast<std::uint64_t>(learner_.iteration),
                                         static_cast<std::uint64_t>(group)});
      collect_group(environment_, group, learner_.agent, sigma, config_.gamma, config_.lambda, random,
                    collect_[index], buffer_.groups[index]);
    });
  }

  /// The roll-out's observations join the statistics only now: acting and learning saw the same scale.
  void absorb_observations() {
    std::vector<nn::Moments> moments;
    for (const GroupRollout& group : buffer_.groups) moments.push_back(group.moments);
    nn::update(learner_.agent.observations, std::span<const nn::Moments>(moments));
  }

  PpoConfig config_;
  E& environment_;
  Learner learner_;
  RolloutBuffer buffer_;
  std::vector<CollectScratch> collect_;
  UpdateScratch update_;
  std::vector<int> rows_;  ///< all rows of the buffer
};

}  // namespace mimicx::rl
