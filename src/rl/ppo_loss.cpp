#include "rl/ppo_loss.h"

#include "nn/gradient.h"

namespace mimicx::rl {

using nn::Tape;
using nn::Var;

template <class S>
nn::Var log_density(nn::Tape<S>& tape, nn::Var means, nn::Var actions, S sigma) {
  const nn::Var squares = nn::row_sum(tape, nn::square(tape, nn::sub(tape, actions, means)));
  return nn::scale(tape, squares, S(-0.5) / (sigma * sigma));
}

template <class S>
nn::Var surrogate_loss(nn::Tape<S>& tape, nn::Var log_density, nn::Var old_log_density, nn::Var advantages,
                       S clip) {
  const nn::Var log_ratio = nn::clamp(tape, nn::sub(tape, log_density, old_log_density), S(-20), S(20));
  const nn::Var ratio = nn::exp(tape, log_ratio);
  const nn::Var clipped = nn::clamp(tape, ratio, S(1) - clip, S(1) + clip);
  const nn::Var gain =
      nn::minimum(tape, nn::multiply(tape, ratio, advantages), nn::multiply(tape, clipped, advantages));
  return nn::scale(tape, nn::sum(tape, gain), S(-1));
}

template <class S>
nn::Var gradient_penalty(nn::Tape<S>& tape, const nn::Mlp<S>& actor, std::span<const nn::Var> parameters,
                         nn::Var observations, nn::Var actions, S sigma) {
  // Rows do not influence each other, so the gradient of the sum holds each row's own gradient.
  const nn::Var means = nn::forward(tape, actor, parameters, observations);
  const nn::Var total = nn::sum(tape, log_density(tape, means, actions, sigma));
  const nn::Var wrt[] = {observations};
  const nn::Var slope = nn::gradient(tape, total, wrt).front();
  return nn::scale(tape, nn::sum(tape, nn::square(tape, slope)), sigma * sigma);
}

template <class S>
nn::Var value_loss(nn::Tape<S>& tape, nn::Var values, nn::Var targets) {
  return nn::scale(tape, nn::sum(tape, nn::square(tape, nn::sub(tape, values, targets))), S(0.5));
}

template nn::Var log_density(nn::Tape<float>&, nn::Var, nn::Var, float);
template nn::Var log_density(nn::Tape<double>&, nn::Var, nn::Var, double);
template nn::Var surrogate_loss(nn::Tape<float>&, nn::Var, nn::Var, nn::Var, float);
template nn::Var surrogate_loss(nn::Tape<double>&, nn::Var, nn::Var, nn::Var, double);
template nn::Var gradient_penalty(nn::Tape<float>&, const nn::Mlp<float>&, std::span<const nn::Var>, nn::Var,
                                  nn::Var, float);
template nn::Var gradient_penalty(nn::Tape<double>&, const nn::Mlp<double>&, std::span<const nn::Var>,
                                  nn::Var, nn::Var, double);
template nn::Var value_loss(nn::Tape<float>&, nn::Var, nn::Var);
template nn::Var value_loss(nn::Tape<double>&, nn::Var, nn::Var);

}  // namespace mimicx::rl
