/// Multi-layer perceptron: parameters, a differentiable forward pass, and a forward pass without a tape.
#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "nn/ops.h"

namespace mimicx::nn {

/// y = W_L(… elu(x·W_1 + b_1) …) + b_L: elu follows every layer but the last.
template <class S>
struct Mlp {
  std::vector<int> sizes;          ///< inputs, widths of the hidden layers, outputs
  std::vector<Matrix<S>> weights;  ///< [layer] in × out
  std::vector<Matrix<S>> biases;   ///< [layer] 1 × out

  int layers() const { return static_cast<int>(weights.size()); }
  int inputs() const { return sizes.front(); }
  int outputs() const { return sizes.back(); }
};

/// Biases 0; weights normal with deviation 1/√fan-in; the last layer's deviation is last_scale/√fan-in
/// (small: the untrained policy acts near its bias).
/// @throws std::invalid_argument for fewer than two sizes or a size < 1.
template <class S>
Mlp<S> make_mlp(const std::vector<int>& sizes, S last_scale, Random& random);

/// The parameters in their fixed order W_1, b_1, W_2, b_2 …
template <class S>
std::vector<Matrix<S>*> parameters(Mlp<S>& mlp);
/// The parameters as nodes of a tape, in the same order, by reference: the network must not change during the
/// pass.
template <class S>
std::vector<Var> parameters_on_tape(Tape<S>& tape, const Mlp<S>& mlp);

/// @param parameters  from `parameters_on_tape`
/// @param x           [n, inputs]  @return [n, outputs]
template <class S>
Var forward(Tape<S>& tape, const Mlp<S>& mlp, std::span<const Var> parameters, Var x);

/// Buffers of `evaluate`, one per worker.
template <class S>
struct Workspace {
  std::vector<Matrix<S>> hidden;  ///< [hidden layer]
};

/// The value of `forward`, bit for bit, without a tape; allocates only when a shape changes.
/// @param input  [n, inputs]  @param output  [n, outputs], resized
template <class S>
void evaluate(const Mlp<S>& mlp, const Matrix<S>& input, Workspace<S>& workspace, Matrix<S>& output);

}  // namespace mimicx::nn
