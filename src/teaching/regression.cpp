#include "teaching/regression.h"

#include <algorithm>

#include "core/parallel.h"
#include "core/random.h"
#include "nn/gradient.h"

namespace mimicx::teaching {
namespace {

void gather(const Lessons& lessons, std::span<const int> rows, int state_size, RegressionSlot& slot) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  slot.states.resize(n, state_size);
  slot.actions.resize(n, kDofs);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(k)]);
    std::copy_n(lessons.states.data() + row * static_cast<std::size_t>(state_size), state_size,
                slot.states.row(k).data());
    std::copy_n(lessons.actions.data() + row * kDofs, kDofs, slot.actions.row(k).data());
  }
}

/// Gradient of the loss over the slot's rows, each of which counts `share`.
void take_gradient(const WeighedLessons& data, std::span<const int> rows, const rl::Agent& agent, float share,
                   RegressionSlot& slot) {
  gather(data.lessons, rows, agent.actor.inputs(), slot);
  nn::normalise(agent.observations, slot.states, slot.normalised);
  nn::Tape<float>& tape = slot.tape;
  tape.reset();
  const auto parameters = nn::parameters_on_tape(tape, agent.actor);
  const nn::Var means = nn::forward(tape, agent.actor, parameters, tape.refer(slot.normalised));
  const nn::Matrix<float> error = tape.value(means) - slot.actions;
  slot.pull.resize(error.rows(), error.cols());
  slot.loss = 0.0;
  for (Eigen::Index k = 0; k < error.rows(); ++k) {
    const int row = rows[static_cast<std::size_t>(k)];
    const Eigen::MatrixXf& W = data.importance[data.lessons.weighed_by[row]];
    slot.pull.row(k).noalias() = share * (error.row(k) * W);
    slot.loss += 0.5 * static_cast<double>(error.row(k).dot(slot.pull.row(k)));
  }
  // W (μ − u) is dL/dμ: held constant, its product with μ has the loss's gradient.
  const nn::Var total = nn::sum(tape, nn::multiply(tape, means, tape.refer(slot.pull)));
  slot.gradient.clear();
  for (const nn::Var g : nn::gradient(tape, total, std::span<const nn::Var>(parameters)))
    slot.gradient.push_back(tape.value(g));
}

}  // namespace

PolicyInTraining untrained_policy(int state_size, const std::vector<int>& hidden, std::uint64_t seed) {
  PolicyInTraining policy{rl::make_agent({state_size, kDofs, hidden}, seed), {}};
  policy.adam = nn::make_adam<float>(nn::parameters(policy.agent.actor));
  return policy;
}

double regression_step(const WeighedLessons& data, const RegressionStep& step, const RegressionConfig& config,
                       int threads, PolicyInTraining& policy, RegressionScratch& scratch) {
  if (scratch.slots.count() != config.slots) scratch.slots = List<RegressionSlot>(config.slots);
  const float share = 1.0f / static_cast<float>(step.rows.size());
  parallel_for(config.slots, threads, [&](int k) {
    const auto rows = part(step.rows, static_cast<std::size_t>(k), scratch.slots.size());
    take_gradient(data, rows, policy.agent, share, scratch.slots[k]);
  });
  std::vector<nn::Matrix<float>>& gradient = scratch.slots.front().gradient;
  double loss = scratch.slots.front().loss;
  for (int k = 1; k < config.slots; ++k) {
    loss += scratch.slots[k].loss;
    for (std::size_t p = 0; p < gradient.size(); ++p) gradient[p] += scratch.slots[k].gradient[p];
  }
  nn::clip_gradient_norm<float>(std::span<nn::Matrix<float>>(gradient), config.gradient_norm);
  const std::vector<nn::Matrix<float>*> parameters = nn::parameters(policy.agent.actor);
  nn::adam_step<float>(policy.adam, parameters, std::span<const nn::Matrix<float>>(gradient),
                       static_cast<float>(step.step_size));
  return loss;
}

std::optional<double> regression_round(const WeighedLessons& data, const RegressionRound& round,
                                       const RegressionConfig& config, const control::PlanControl& control,
                                       Random& random, PolicyInTraining& policy) {
  RegressionScratch scratch;
  List<int> rows(config.minibatch);
  double loss = 0.0;
  for (int step = 0; step < round.steps; ++step) {
    if (control.should_stop && control.should_stop()) return {};
    for (int& row : rows)
      row = static_cast<int>(random.below(static_cast<std::uint32_t>(data.lessons.rows())));
    const double done = (round.round + (step + 0.5) / round.steps) / round.rounds;
    const double left = 1.0 - std::min(done, 1.0);
    const double step_size = round.last_step_size + left * left * (round.step_size - round.last_step_size);
    loss += regression_step(data, {rows, step_size}, config, control.threads, policy, scratch) / round.steps;
  }
  return loss;
}

}  // namespace mimicx::teaching
