/// Adam on any set of parameters: one tape, one optimiser.
#pragma once

#include <span>
#include <vector>

#include "nn/adam.h"
#include "nn/mlp.h"

namespace mimicx::nn {

class ParameterTraining {
 public:
  /// The parameters must outlive the training.
  /// @param gradient_norm  limit of the gradient's norm
  explicit ParameterTraining(std::vector<Matrix<float>*> parameters, double gradient_norm = 1.0);

  /// An empty tape with the parameters as its first nodes.
  Tape<float>& start();
  /// `count` of the parameters' nodes, from that of index `first`.
  std::span<const Var> nodes(std::size_t first, std::size_t count) const {
    return std::span(nodes_).subspan(first, count);
  }
  /// A step down the gradient of the 1×1 node. @return its value
  double descend(Var loss, double step_size);

 private:
  std::vector<Matrix<float>*> parameters_;
  double gradient_norm_;
  Adam<float> adam_;
  Tape<float> tape_;
  std::vector<Var> nodes_;
};

/// Parameters of several networks, in order.
std::vector<Matrix<float>*> parameters_of(std::span<Mlp<float>* const> networks);

/// Step size after a share of all steps: falls linearly to a tenth.
inline double falling_step_size(double at_start, int step, int steps) {
  return at_start * (1.0 - 0.9 * step / steps);
}

}  // namespace mimicx::nn
