/// Proximal policy optimisation of one agent from a recorded roll-out.
///
/// Source: Schulman et al., "Proximal policy optimization algorithms", 2017, Algorithm 1; ppo.cpp and
/// ppo_config.h cite the sources of details. trainer.h has the loop around it (collect → advantages →
/// update).
///
/// The learner reads rows of a RolloutBuffer and knows no environment: several learners can use their own
/// rows of one roll-out. Same bytes for any number of threads: a minibatch is cut into a fixed number of
/// slots, each slot sums its gradients pass by pass, and the slots are added in order.
#pragma once

#include <string>

#include "nn/adam.h"
#include "nn/tape.h"
#include "rl/policy.h"
#include "rl/ppo_config.h"
#include "rl/rollout.h"

namespace mimicx::rl {

/// The complete state of a training. Plain values: copy it to branch off, save it to continue.
struct Learner {
  Agent agent;
  nn::Adam<float> actor_adam, critic_adam;
  double step_size = 0.0;  ///< the actor's, adapted to the KL
  std::int64_t iteration = 0;
  std::int64_t samples = 0;  ///< drawn so far
};

Learner make_learner(const PpoConfig& config, Agent agent);

/// Statistics of one iteration. Losses, KL and norms are means over its minibatches unless stated otherwise.
struct IterationStats {
  std::int64_t iteration = 0;        ///< counted from 0
  std::int64_t samples = 0;          ///< drawn so far, this iteration included
  double mean_reward = 0.0;          ///< per step, of the rewards that it learns from
  double mean_episode_length = 0.0;  ///< of the episodes that ended, steps; 0 if none ended
  double explained_variance = 0.0;   ///< 1 − Var(return − V)/Var(return), before the update
  double saturation = 0.0;           ///< share of the mean actions' components beyond ± 3
  double sigma = 0.0;
  int minibatches = 0;  ///< gradient steps taken; 0 in the first iteration, which only measures observations
  double policy_loss = 0.0, value_loss = 0.0, penalty = 0.0, clip_fraction = 0.0;
  double actor_gradient = 0.0, critic_gradient = 0.0;  ///< norms before clipping
  double kl = 0.0;         ///< KL(old ‖ new): mean of the last epoch, or of the minibatch that stopped it
  double step_size = 0.0;  ///< the actor's during this iteration
};

/// Sums over the rows of one slot in the current minibatch.
struct LossSums {
  double policy_loss = 0.0, value_loss = 0.0, penalty = 0.0, clipped = 0.0, kl = 0.0;
};

/// One slot's tapes, gathered rows and gradients.
struct GradientSlot {
  nn::Tape<float> actor_tape, critic_tape;
  nn::Matrix<float> observations, actions, old_means;      ///< [pass rows × dim]
  nn::Matrix<float> old_log_density, advantages, targets;  ///< [pass rows × 1]
  nn::Matrix<float> penalty_observations, penalty_actions;
  std::vector<nn::Matrix<float>> actor_gradient, critic_gradient;
  LossSums sums;
};

/// The workers of `update` and their buffers, whose contents do not matter.
struct UpdateWorkers {
  int threads = 1;  ///< the result does not depend on it
  List<GradientSlot> slots;
  std::vector<int> order;  ///< shuffled rows

  explicit UpdateWorkers(const PpoConfig& config) : slots(config.gradient_slots) {}
};

/// The rows of a roll-out that an agent learns from. Refers to its parts.
struct LearningRows {
  const RolloutBuffer& buffer;  ///< with its advantages
  std::span<const int> rows;    ///< in [0, buffer.rows())
  double sigma;                 ///< σ under which they were collected
};

/// Key of the shuffles, together with iteration and epoch.
struct ShuffleKey {
  std::uint64_t seed;     ///< of the training
  std::uint64_t learner;  ///< index of the learner in the iteration
};

/// All epochs over the given rows; adapts the step size.
void update(Learner& learner, const PpoConfig& config, const LearningRows& data, const ShuffleKey& key,
            UpdateWorkers& workers, IterationStats& stats);

/// Reward, episode length, explained variance and saturation of a roll-out.
void describe_rollout(const RolloutBuffer& buffer, IterationStats& stats);

/// Adam's moments for every parameter of the network. @throws DataError if they do not fit it
nn::Adam<float> load_moments(const Npz& archive, const std::string& prefix, nn::Mlp<float>& network);

void save(Npz& archive, const std::string& prefix, const Learner& learner);
/// @throws DataError naming archive and key
Learner load_learner(const Npz& archive, const std::string& prefix);

}  // namespace mimicx::rl
