/// Adam (Kingma & Ba, ICLR 2015, Algorithm 1), and clipping of a gradient by its norm.
///
/// Square roots use the processor's exact instruction (IEEE 754). Eigen's would use an approximate
/// instruction, whose bits differ between makers of processors.
///
/// Deviation: the powers β₁ᵗ and β₂ᵗ are running products instead of calls of `pow`, whose bits differ
/// between libraries.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nn/matrix.h"

namespace mimicx::nn {

template <class S>
struct Adam {
  S beta1 = S(0.9);
  S beta2 = S(0.999);
  S epsilon = S(1e-8);
  std::int64_t steps = 0;
  double beta1_power = 1.0;       ///< β₁ᵗ after t steps
  double beta2_power = 1.0;       ///< β₂ᵗ
  std::vector<Matrix<S>> first;   ///< [parameter] running mean m of the gradient
  std::vector<Matrix<S>> second;  ///< [parameter] running mean v of its square
};

/// Adam with zero moments for these parameters.
template <class S>
Adam<S> make_adam(std::span<Matrix<S>* const> parameters);

/// One step down the gradient, in place.
/// @throws std::invalid_argument when parameters, gradients and moments do not match in number or shape.
template <class S>
void adam_step(Adam<S>& adam, std::span<Matrix<S>* const> parameters, std::span<const Matrix<S>> gradients,
               S step_size);

/// Euclidean norm of all gradients together; summed in double, in order.
template <class S>
double gradient_norm(std::span<const Matrix<S>> gradients);
/// Scales the gradients down to `max_norm` if their norm exceeds it. @return the norm before.
template <class S>
double clip_gradient_norm(std::span<Matrix<S>> gradients, double max_norm);

}  // namespace mimicx::nn
