#include "rl/ppo_loss.h"

#include "nn/gradient.h"

namespace mimicx::rl {

using nn::Tape;
using nn::Var;

template <class S>
Var log_density(Tape<S>& tape, Var means, Var actions, S sigma) {
  const Var squares = row_sum(tape, square(tape, sub(tape, actions, means)));
  return scale(tape, squares, S(-0.5) / (sigma * sigma));
}

template <class S>
Var surrogate_loss(Tape<S>& tape, Var log_density, Var old_log_density, Var advantages, S clip) {
  const Var log_ratio = clamp(tape, sub(tape, log_density, old_log_density), S(-20), S(20));
  const Var ratio = exp(tape, log_ratio);
  const Var clipped = clamp(tape, ratio, S(1) - clip, S(1) + clip);
  const Var gain = minimum(tape, multiply(tape, ratio, advantages), multiply(tape, clipped, advantages));
  return scale(tape, sum(tape, gain), S(-1));
}

template <class S>
Var gradient_penalty(Tape<S>& tape, const nn::Mlp<S>& actor, std::span<const Var> parameters,
                     Var observations, Var actions, S sigma) {
  // Rows do not influence each other, so the gradient of the sum holds each row's own gradient.
  const Var means = forward(tape, actor, parameters, observations);
  const Var total = sum(tape, log_density(tape, means, actions, sigma));
  const Var wrt[] = {observations};
  const Var slope = gradient(tape, total, wrt).front();
  return scale(tape, sum(tape, square(tape, slope)), sigma * sigma);
}

template <class S>
Var bound_loss(Tape<S>& tape, Var means, S bound) {
  const Var above = activate(tape, scale(tape, means, S(1), -bound), nn::Activation::kRelu);
  const Var below = activate(tape, scale(tape, means, S(-1), -bound), nn::Activation::kRelu);
  return add(tape, sum(tape, square(tape, above)), sum(tape, square(tape, below)));
}

template <class S>
Var value_loss(Tape<S>& tape, Var values, Var targets) {
  return scale(tape, sum(tape, square(tape, sub(tape, values, targets))), S(0.5));
}

template Var log_density(Tape<float>&, Var, Var, float);
template Var log_density(Tape<double>&, Var, Var, double);
template Var surrogate_loss(Tape<float>&, Var, Var, Var, float);
template Var surrogate_loss(Tape<double>&, Var, Var, Var, double);
template Var gradient_penalty(Tape<float>&, const nn::Mlp<float>&, std::span<const Var>, Var, Var, float);
template Var gradient_penalty(Tape<double>&, const nn::Mlp<double>&, std::span<const Var>, Var, Var, double);
template Var bound_loss(Tape<float>&, Var, float);
template Var bound_loss(Tape<double>&, Var, double);
template Var value_loss(Tape<float>&, Var, Var);
template Var value_loss(Tape<double>&, Var, Var);

}  // namespace mimicx::rl
