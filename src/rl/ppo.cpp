#include "rl/ppo.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/parallel.h"
#include "nn/checkpoint.h"
#include "nn/gradient.h"
#include "rl/ppo_loss.h"

namespace mimicx::rl {

namespace {

using Gradients = std::vector<nn::Matrix<float>>;

/// Mean and scale of the advantages of an iteration; the loss uses them centred and scaled (Andrychowicz et
/// al. 2021, choice C67: per batch or minibatch makes no difference).
struct AdvantageScale {
  float mean = 0.0F, factor = 1.0F;
};

constexpr float kSaturatedMean = 3.0F;  ///< mean actions beyond ± this count as saturated

/// Row `row` of the whole buffer: its group and its row there.
struct RowPlace {
  const GroupRollout& group;
  Eigen::Index row;
};

RowPlace place(const RolloutBuffer& buffer, int row) {
  return {buffer.groups[row / buffer.group_rows()], row % buffer.group_rows()};
}

/// The λ-return, target of the critic.
double target(const RowPlace& at) {
  return double{at.group.advantages.data()[at.row]} + double{at.group.values.data()[at.row]};
}

AdvantageScale advantage_scale(const RolloutBuffer& buffer, std::span<const int> rows) {
  double sum = 0.0, squares = 0.0;
  for (const int row : rows) {
    const RowPlace at = place(buffer, row);
    sum += at.group.advantages.data()[at.row];
  }
  const double mean = sum / static_cast<double>(rows.size());
  for (const int row : rows) {
    const RowPlace at = place(buffer, row);
    const double centred = at.group.advantages.data()[at.row] - mean;
    squares += centred * centred;
  }
  const double deviation = std::sqrt(squares / static_cast<double>(rows.size()));
  return {static_cast<float>(mean), static_cast<float>(1.0 / (deviation + 1e-8))};
}

void update_return_scale(ReturnScale& scale, const RolloutBuffer& buffer, std::span<const int> rows,
                         double rate) {
  double sum = 0.0, squares = 0.0;
  for (const int row : rows) {
    const double value = target(place(buffer, row));
    sum += value;
    squares += value * value;
  }
  const double count = static_cast<double>(rows.size());
  follow_returns(scale, sum / count, squares / count, rate);
}

void gather(const RolloutBuffer& buffer, std::span<const int> rows, const AdvantageScale& scale,
            const ReturnScale& returns, GradientSlot& slot) {
  const Eigen::Index n = static_cast<Eigen::Index>(rows.size());
  const GroupRollout& any = buffer.groups.front();
  slot.observations.resize(n, any.observations.cols());
  slot.actions.resize(n, any.actions.cols());
  slot.old_means.resize(n, any.actions.cols());
  slot.old_log_density.resize(n, 1);
  slot.advantages.resize(n, 1);
  slot.targets.resize(n, 1);
  const double deviation = returns.deviation();
  for (Eigen::Index k = 0; k < n; ++k) {
    const RowPlace at = place(buffer, rows[static_cast<std::size_t>(k)]);
    slot.observations.row(k) = at.group.observations.row(at.row);
    slot.actions.row(k) = at.group.actions.row(at.row);
    slot.old_means.row(k) = at.group.means.row(at.row);
    slot.old_log_density(k) = at.group.log_density.data()[at.row];
    slot.advantages(k) = (at.group.advantages.data()[at.row] - scale.mean) * scale.factor;
    slot.targets(k) = static_cast<float>((target(at) - returns.mean) / deviation);
  }
}

void accumulate(const nn::Tape<float>& tape, std::span<const nn::Var> gradient, Gradients& into) {
  for (std::size_t k = 0; k < into.size(); ++k) into[k] += tape.value(gradient[k]);
}

/// KL(old ‖ new) of Gaussians of one covariance is ‖μ_old − μ_new‖²/2σ²: exact, no sampling.
void measure_policy(const nn::Matrix<float>& means, const nn::Matrix<float>& log_density, double sigma,
                    double clip, GradientSlot& slot) {
  const auto log_ratio = (log_density - slot.old_log_density).array();
  const float high = static_cast<float>(log1p(clip)), low = static_cast<float>(log1p(-clip));
  slot.sums.clipped += static_cast<double>((log_ratio > high || log_ratio < low).count());
  for (Eigen::Index k = 0; k < means.rows(); ++k)
    slot.sums.kl += 0.5 * double{(means.row(k) - slot.old_means.row(k)).squaredNorm()} / (sigma * sigma);
}

/// Adds the gradient of the actor's loss on the gathered rows, part of a minibatch of `batch_rows`.
void actor_pass(const Agent& agent, const PpoConfig& config, double sigma, std::size_t batch_rows,
                GradientSlot& slot) {
  nn::Tape<float>& tape = slot.actor_tape;
  const float share = 1.0F / static_cast<float>(batch_rows), deviation = static_cast<float>(sigma);
  tape.reset();
  const auto parameters = nn::parameters_on_tape(tape, agent.actor);
  const nn::Var means = nn::forward(tape, agent.actor, parameters, tape.refer(slot.observations));
  const nn::Var density = log_density(tape, means, tape.refer(slot.actions), deviation);
  const nn::Var surrogate = surrogate_loss(tape, density, tape.refer(slot.old_log_density),
                                           tape.refer(slot.advantages), static_cast<float>(config.clip));
  nn::Var loss = nn::scale(tape, surrogate, share);
  if (config.penalty_weight > 0.0) {
    // The rows are shuffled, so the first ones are a random sample of all rows of the pass.
    const Eigen::Index n = slot.observations.rows();
    const auto wanted = static_cast<Eigen::Index>(std::lround(config.penalty_fraction * double(n)));
    const Eigen::Index sample = std::clamp<Eigen::Index>(wanted, 1, n);
    slot.penalty_observations = slot.observations.topRows(sample);
    slot.penalty_actions = slot.actions.topRows(sample);
    const nn::Var penalty =
        gradient_penalty(tape, agent.actor, parameters, tape.refer(slot.penalty_observations),
                         tape.refer(slot.penalty_actions), deviation);
    const double weight = double(n) / double(sample);
    loss = nn::add(tape, loss,
                   nn::scale(tape, penalty, static_cast<float>(config.penalty_weight * weight) * share));
    slot.sums.penalty += weight * double{tape.scalar(penalty)};
  }
  slot.sums.policy_loss += tape.scalar(surrogate);
  measure_policy(tape.value(means), tape.value(density), sigma, config.clip, slot);
  accumulate(tape, nn::gradient(tape, loss, parameters), slot.actor_gradient);
}

void critic_pass(const Agent& agent, std::size_t batch_rows, GradientSlot& slot) {
  nn::Tape<float>& tape = slot.critic_tape;
  tape.reset();
  const auto parameters = nn::parameters_on_tape(tape, agent.critic);
  const nn::Var values = nn::forward(tape, agent.critic, parameters, tape.refer(slot.observations));
  const nn::Var error = value_loss(tape, values, tape.refer(slot.targets));
  const nn::Var loss = nn::scale(tape, error, 1.0F / static_cast<float>(batch_rows));
  slot.sums.value_loss += tape.scalar(error);
  accumulate(tape, nn::gradient(tape, loss, parameters), slot.critic_gradient);
}

void clear(const nn::Mlp<float>& mlp, Gradients& gradients) {
  gradients.resize(2 * mlp.weights.size());
  for (std::size_t layer = 0; layer < mlp.weights.size(); ++layer) {
    gradients[2 * layer].setZero(mlp.weights[layer].rows(), mlp.weights[layer].cols());
    gradients[2 * layer + 1].setZero(1, mlp.biases[layer].cols());
  }
}

/// Gradients of one minibatch, slot by slot. @return the losses summed over the slots, in their order
LossSums take_gradients(const Agent& agent, const PpoConfig& config, const LearningRows& batch,
                        const AdvantageScale& advantages, UpdateWorkers& workers) {
  parallel_for(config.gradient_slots, workers.threads, [&](int index) {
    GradientSlot& slot = workers.slots[index];
    slot.sums = {};
    clear(agent.actor, slot.actor_gradient);
    clear(agent.critic, slot.critic_gradient);
    const auto mine = part(batch.rows, static_cast<std::size_t>(index), workers.slots.size());
    const auto pass_rows = static_cast<std::size_t>(config.pass_rows);
    const std::size_t passes = (mine.size() + pass_rows - 1) / pass_rows;
    for (std::size_t pass = 0; pass < passes; ++pass) {
      gather(batch.buffer, part(mine, pass, passes), advantages, agent.returns, slot);
      actor_pass(agent, config, batch.sigma, batch.rows.size(), slot);
      critic_pass(agent, batch.rows.size(), slot);
    }
  });
  LossSums total;
  for (const GradientSlot& slot : workers.slots) {
    total.policy_loss += slot.sums.policy_loss;
    total.value_loss += slot.sums.value_loss;
    total.penalty += slot.sums.penalty;
    total.clipped += slot.sums.clipped;
    total.kl += slot.sums.kl;
  }
  return total;
}

/// Adds the slots' gradients into the first slot's, clips and steps. @return the norm before clipping
double descend(nn::Mlp<float>& mlp, nn::Adam<float>& adam, Gradients GradientSlot::*gradients,
               double max_norm, double step_size, UpdateWorkers& workers) {
  Gradients& total = workers.slots.front().*gradients;
  for (std::size_t slot = 1; slot < workers.slots.size(); ++slot)
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += (workers.slots[slot].*gradients)[k];
  const double norm = nn::clip_gradient_norm<float>(total, max_norm);
  nn::adam_step<float>(adam, parameters(mlp), total, static_cast<float>(step_size));
  return norm;
}

/// Both networks step in parallel: they share no data.
void step_networks(Learner& learner, const PpoConfig& config, UpdateWorkers& workers, IterationStats& stats) {
  double norms[2] = {0.0, 0.0};
  parallel_for(2, workers.threads, [&](int network) {
    if (network == 0)
      norms[0] = descend(learner.agent.actor, learner.actor_adam, &GradientSlot::actor_gradient,
                         config.gradient_norm, learner.step_size, workers);
    else
      norms[1] = descend(learner.agent.critic, learner.critic_adam, &GradientSlot::critic_gradient,
                         config.gradient_norm, config.critic_step_size, workers);
  });
  stats.actor_gradient += norms[0];
  stats.critic_gradient += norms[1];
  ++stats.minibatches;
}

void average(IterationStats& stats) {
  const double count = std::max(stats.minibatches, 1);
  for (double* sum : {&stats.policy_loss, &stats.value_loss, &stats.penalty, &stats.clip_fraction,
                      &stats.actor_gradient, &stats.critic_gradient})
    *sum /= count;
}

}  // namespace

double exploration_sigma(const PpoConfig& config, std::int64_t falling_samples, std::int64_t samples) {
  if (falling_samples <= 0) return config.sigma_end;
  const double progress = std::min(1.0, double(samples) / double(falling_samples));
  return config.sigma_start + progress * (config.sigma_end - config.sigma_start);
}

double adapted_step_size(const PpoConfig& config, double step_size, double kl) {
  if (kl > 2.0 * config.kl_target)
    step_size /= config.step_factor;
  else if (kl < 0.5 * config.kl_target)
    step_size *= config.step_factor;
  return std::clamp(step_size, config.step_min, config.step_max);
}

Learner make_learner(const PpoConfig& config, Agent agent) {
  Learner learner;
  learner.agent = std::move(agent);
  learner.actor_adam = nn::make_adam<float>(parameters(learner.agent.actor));
  learner.critic_adam = nn::make_adam<float>(parameters(learner.agent.critic));
  learner.step_size = config.step_size;
  return learner;
}

void update(Learner& learner, const PpoConfig& config, const LearningRows& data, const ShuffleKey& key,
            UpdateWorkers& workers, IterationStats& stats) {
  const auto& [buffer, rows, sigma] = data;
  if (rows.empty()) return;
  stats.step_size = learner.step_size;
  update_return_scale(learner.agent.returns, buffer, rows, config.return_rate);
  const AdvantageScale advantages = advantage_scale(buffer, rows);
  const auto minibatches =
      static_cast<std::size_t>(std::max(1L, std::lround(double(rows.size()) / double(config.minibatch))));
  bool stopped = false;
  workers.order.assign(rows.begin(), rows.end());
  for (int epoch = 0; epoch < config.epochs && !stopped; ++epoch) {
    Random random(key.seed, {kShuffle, key.learner, static_cast<std::uint64_t>(learner.iteration),
                             static_cast<std::uint64_t>(epoch)});
    shuffle(workers.order, random);
    double epoch_kl = 0.0;
    for (std::size_t k = 0; k < minibatches; ++k) {
      const LearningRows batch{buffer, part(workers.order, k, minibatches), sigma};
      const double count = static_cast<double>(batch.rows.size());
      const LossSums sums = take_gradients(learner.agent, config, batch, advantages, workers);
      const double kl = sums.kl / count;
      stopped = kl > config.kl_stop * config.kl_target;
      stats.kl = kl;
      if (stopped) break;
      epoch_kl += kl;
      stats.policy_loss += sums.policy_loss / count;
      stats.value_loss += sums.value_loss / count;
      stats.penalty += sums.penalty / count;
      stats.clip_fraction += sums.clipped / count;
      step_networks(learner, config, workers, stats);
    }
    if (!stopped) stats.kl = epoch_kl / static_cast<double>(minibatches);
  }
  average(stats);
  // The KL that a step causes is measured by the next minibatch.
  if (stopped || stats.minibatches > 1)
    learner.step_size = adapted_step_size(config, learner.step_size, stats.kl);
}

void describe_rollout(const RolloutBuffer& buffer, IterationStats& stats) {
  double reward = 0.0, saturated = 0.0, components = 0.0;
  double error = 0.0, error_squares = 0.0, target_sum = 0.0, target_squares = 0.0;
  std::int64_t episodes = 0, steps = 0;
  for (const GroupRollout& group : buffer.groups) {
    for (Eigen::Index row = 0; row < group.rewards.size(); ++row) {
      const double advantage = group.advantages.data()[row], goal = target({group, row});
      reward += group.rewards.data()[row];
      error += advantage;
      error_squares += advantage * advantage;
      target_sum += goal;
      target_squares += goal * goal;
    }
    saturated += static_cast<double>((group.means.array().abs() > kSaturatedMean).count());
    components += static_cast<double>(group.means.size());
    episodes += group.ended_episodes;
    steps += group.ended_steps;
  }
  const double count = buffer.rows();
  const double error_variance = error_squares / count - (error / count) * (error / count);
  const double target_variance = target_squares / count - (target_sum / count) * (target_sum / count);
  stats.mean_reward = reward / count;
  stats.mean_episode_length = episodes > 0 ? double(steps) / double(episodes) : 0.0;
  stats.explained_variance = target_variance > 0.0 ? 1.0 - error_variance / target_variance : 0.0;
  stats.saturation = components > 0.0 ? saturated / components : 0.0;
}

void save(Npz& archive, const std::string& prefix, const Learner& learner) {
  save(archive, prefix + "agent.", learner.agent);
  nn::save(archive, prefix + "actor_adam.", learner.actor_adam);
  nn::save(archive, prefix + "critic_adam.", learner.critic_adam);
  archive.set(prefix + "step_size", NpyArray::scalar(learner.step_size));
  archive.set(prefix + "iteration", NpyArray::scalar_int(learner.iteration));
  archive.set(prefix + "samples", NpyArray::scalar_int(learner.samples));
}

nn::Adam<float> load_moments(const Npz& archive, const std::string& prefix, nn::Mlp<float>& network) {
  nn::Adam<float> adam = nn::load_adam<float>(archive, prefix);
  const auto weights = parameters(network);
  bool fits = adam.first.size() == weights.size();
  for (std::size_t k = 0; fits && k < weights.size(); ++k)
    fits = adam.first[k].rows() == weights[k]->rows() && adam.first[k].cols() == weights[k]->cols();
  if (!fits) throw DataError(archive.path, prefix + "first", "moments of every parameter", "others");
  return adam;
}

Learner load_learner(const Npz& archive, const std::string& prefix) {
  Learner learner;
  learner.agent = load_agent(archive, prefix + "agent.");
  learner.actor_adam = load_moments(archive, prefix + "actor_adam.", learner.agent.actor);
  learner.critic_adam = load_moments(archive, prefix + "critic_adam.", learner.agent.critic);
  learner.step_size = number_at(archive, prefix + "step_size");
  learner.iteration = whole_number_at(archive, prefix + "iteration");
  learner.samples = whole_number_at(archive, prefix + "samples");
  return learner;
}

}  // namespace mimicx::rl
