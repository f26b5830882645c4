/// Adam on any set of parameters: one tape, one optimiser.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "nn/adam.h"
#include "nn/mlp.h"

namespace mimicx::generate {

/// Streams of random numbers of the room.
enum RandomPurpose : std::uint64_t {
  kDiffusionInit = 0x7101,
  kDiffusionBatches,
  kDiffusionSamples,
  kCodeInit,
  kCodeBatches,
  kPredictorBatches,
  kCodeSamples,
  kRecogniserInit,
  kRecogniserBatches
};

class ParameterTraining {
 public:
  /// The parameters must outlive the training.
  explicit ParameterTraining(std::vector<nn::Matrix<float>*> parameters);

  /// An empty tape with the parameters as its first nodes.
  nn::Tape<float>& start();
  /// `count` of the parameters' nodes, from that of index `first`.
  std::span<const nn::Var> nodes(std::size_t first, std::size_t count) const {
    return std::span(nodes_).subspan(first, count);
  }
  /// A step down the gradient of the 1×1 node. @return its value
  double descend(nn::Var loss, double step_size);

 private:
  std::vector<nn::Matrix<float>*> parameters_;
  nn::Adam<float> adam_;
  nn::Tape<float> tape_;
  std::vector<nn::Var> nodes_;
};

/// Parameters of several networks, in order.
std::vector<nn::Matrix<float>*> parameters_of(std::span<nn::Mlp<float>* const> networks);

/// Step size after a share of all steps: falls linearly to a tenth.
inline double falling_step_size(double at_start, int step, int steps) {
  return at_start * (1.0 - 0.9 * step / steps);
}

}  // namespace mimicx::generate
