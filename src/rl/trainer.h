/// The training loop: collect → advantages → update, for one or several agents in one environment.
///
/// Several agents learn jointly (docs/method.md §9): the environment names the agent that acts for a
/// character; every agent values, and learns from, its own rows. Random numbers are keyed by their purpose:
/// the noise of the actions by (seed, purpose, iteration, group). `save` writes the complete state between
/// two iterations. A trainer of the same configuration, seed and environment that loads it continues with the
/// same bytes as one that was never interrupted.
#pragma once

#include <stdexcept>

#include "core/error.h"
#include "core/parallel.h"
#include "nn/checkpoint.h"
#include "rl/environment.h"
#include "rl/ppo.h"

namespace mimicx::rl {

/// Settings that may differ between two trainings of one configuration.
struct Course {
  std::uint64_t seed;            ///< of action noise and shuffles
  std::int64_t falling_samples;  ///< samples over which σ falls
};

template <Environment World>
class PpoTrainer {
 public:
  /// @param agents       environment.agents() of them, all of one shape
  /// @param environment  by reference, must outlive the trainer
  /// @throws std::invalid_argument for a wrong number of agents
  PpoTrainer(const PpoConfig& config, const Course& course, std::vector<Agent> agents, World& environment)
      : config_(config),
        course_(course),
        environment_(environment),
        buffer_(make_rollout_buffer(environment.groups(), environment.group_size(), config.horizon,
                                    environment.observation_dim(), environment.action_dim(),
                                    static_cast<int>(agents.size()))),
        collect_(environment.groups(),
                 CollectScratch(environment.group_size(), environment.observation_dim())),
        workers_(config),
        rows_(agents.size()) {
    if (static_cast<int>(agents.size()) != environment.agents())
      throw std::invalid_argument("PpoTrainer: " + std::to_string(agents.size()) + " agents where " +
                                  std::to_string(environment.agents()) + " act");
    for (Agent& agent : agents) learners_.push_back(make_learner(config, std::move(agent)));
  }

  /// One iteration. The result does not depend on the number of threads.
  IterationStats iterate(int threads) {
    IterationStats stats;
    stats.iteration = iteration_;
    stats.sigma = exploration_sigma(config_, course_.falling_samples, samples_);

    collect(stats.sigma, threads);
    const std::vector<CharacterPlace> restarted = environment_.end_iteration();
    for (const auto [group, character] : restarted) buffer_.groups[group].ages[character] = 0;
    samples_ += buffer_.rows();
    stats.samples = samples_;
    describe_rollout(buffer_, stats);
    assign_rows();
    workers_.threads = threads;
    std::vector<IterationStats> parts(learners_.size(), stats);
    for (std::size_t k = 0; k < learners_.size(); ++k) {
      Learner& learner = learners_[k];
      // The first roll-out only measures the observations: learning uses the scale with which the agents
      // acted, and for the first roll-out that is unknown.
      if (learner.agent.observations.moments.count > 0)
        update(learner, config_, {buffer_, rows_[k], stats.sigma}, {course_.seed, k}, workers_, parts[k]);
      learner.samples += static_cast<std::int64_t>(rows_[k].size());
      ++learner.iteration;
    }
    absorb_observations();
    ++iteration_;
    return average(parts);
  }

  std::int64_t iterations() const { return iteration_; }
  std::int64_t samples() const { return samples_; }  ///< of all agents
  const std::vector<Learner>& learners() const { return learners_; }
  const Learner& learner() const { return learners_.front(); }
  const RolloutBuffer& buffer() const { return buffer_; }
  std::vector<Agent> agents() const {
    std::vector<Agent> agents;
    for (const Learner& learner : learners_) agents.push_back(learner.agent);
    return agents;
  }

  void save(Npz& archive, const std::string& prefix) const {
    for (std::size_t k = 0; k < learners_.size(); ++k)
      rl::save(archive, prefix + "learner" + std::to_string(k) + ".", learners_[k]);
    archive.set(prefix + "iteration", NpyArray::scalar_int(iteration_));
    archive.set(prefix + "samples", NpyArray::scalar_int(samples_));
    std::vector<std::int64_t> ages;
    for (const GroupRollout& group : buffer_.groups)
      ages.insert(ages.end(), group.ages.begin(), group.ages.end());
    archive.set(prefix + "ages", NpyArray::from_int64({ages.size()}, ages.data()));
    environment_.save(archive, prefix + "environment.");
  }

  /// @throws DataError if the archive does not fit this trainer
  void load(const Npz& archive, const std::string& prefix) {
    for (std::size_t k = 0; k < learners_.size(); ++k) {
      const std::string key = prefix + "learner" + std::to_string(k) + ".";
      Learner loaded = load_learner(archive, key);
      const Agent &here = learners_[k].agent, &there = loaded.agent;
      if (there.actor.sizes != here.actor.sizes || there.critic.sizes != here.critic.sizes)
        throw DataError(archive.path, key, "networks of this training's sizes", "others");
      learners_[k] = std::move(loaded);
    }
    iteration_ = whole_number_at(archive, prefix + "iteration");
    samples_ = whole_number_at(archive, prefix + "samples");
    const auto size = static_cast<std::size_t>(buffer_.group_size);
    const std::vector<std::int64_t> ages =
        nn::whole_numbers_at(archive, prefix + "ages", size * buffer_.groups.size());
    for (std::size_t i = 0; i < ages.size(); ++i) buffer_.groups[i / size].ages[i % size] = ages[i];
    environment_.load(archive, prefix + "environment.");
  }

 private:
  void collect(double sigma, int threads) {
    CollectSettings settings{{}, sigma, {config_.gamma, config_.lambda}};
    for (const Learner& learner : learners_) settings.agents.push_back(&learner.agent);
    parallel_for(buffer_.groups.count(), threads, [&](int group) {
      const Random random(course_.seed, {kActionNoise, static_cast<std::uint64_t>(iteration_),
                                         static_cast<std::uint64_t>(group)});
      collect_group(environment_, group, settings, random, collect_[group], buffer_.groups[group]);
    });
  }

  /// rows_[k]: the rows of the buffer in which agent k acted.
  void assign_rows() {
    for (auto& rows : rows_) rows.clear();
    int row = 0;
    for (const GroupRollout& group : buffer_.groups)
      for (const int actor : group.actors) rows_[actor].push_back(row++);
  }

  /// Adds the roll-out's observations to the statistics, after learning: acting and learning use the same
  /// scale.
  void absorb_observations() {
    for (std::size_t k = 0; k < learners_.size(); ++k) {
      std::vector<nn::Moments> moments;
      for (const GroupRollout& group : buffer_.groups) moments.push_back(group.moments[k]);
      nn::update(learners_[k].agent.observations, std::span<const nn::Moments>(moments));
    }
  }

  /// Mean of the learners' statistics, weighted by their rows.
  IterationStats average(const std::vector<IterationStats>& parts) const {
    if (parts.size() == 1) return parts.front();
    IterationStats total = parts.front();
    const auto mean = [&](double IterationStats::*member) {
      double sum = 0.0;
      for (std::size_t k = 0; k < parts.size(); ++k)
        sum += parts[k].*member * static_cast<double>(rows_[k].size());
      return sum / buffer_.rows();
    };
    for (const auto member :
         {&IterationStats::policy_loss, &IterationStats::value_loss, &IterationStats::penalty,
          &IterationStats::clip_fraction, &IterationStats::actor_gradient, &IterationStats::critic_gradient,
          &IterationStats::kl, &IterationStats::step_size})
      total.*member = mean(member);
    total.minibatches = 0;
    for (const IterationStats& part : parts) total.minibatches += part.minibatches;
    return total;
  }

  PpoConfig config_;
  Course course_;
  World& environment_;
  std::vector<Learner> learners_;
  std::int64_t iteration_ = 0, samples_ = 0;
  RolloutBuffer buffer_;
  List<CollectScratch> collect_;
  UpdateWorkers workers_;
  List<std::vector<int>> rows_;  ///< [agent]
};

}  // namespace mimicx::rl
