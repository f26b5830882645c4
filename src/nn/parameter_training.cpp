#include "nn/parameter_training.h"

#include "nn/gradient.h"

namespace mimicx::nn {

ParameterTraining::ParameterTraining(std::vector<Matrix<float>*> parameters, double gradient_norm)
    : parameters_(std::move(parameters)),
      gradient_norm_(gradient_norm),
      adam_(make_adam<float>(parameters_)) {}

Tape<float>& ParameterTraining::start() {
  tape_.reset();
  nodes_.clear();
  for (const Matrix<float>* parameter : parameters_) nodes_.push_back(tape_.refer(*parameter));
  return tape_;
}

double ParameterTraining::descend(Var loss, double step_size) {
  const double value = double{tape_.scalar(loss)};
  std::vector<Matrix<float>> gradients;
  for (const Var node : gradient<float>(tape_, loss, nodes_)) gradients.push_back(tape_.value(node));
  clip_gradient_norm<float>(gradients, gradient_norm_);
  adam_step<float>(adam_, parameters_, gradients, static_cast<float>(step_size));
  return value;
}

std::vector<Matrix<float>*> parameters_of(std::span<Mlp<float>* const> networks) {
  std::vector<Matrix<float>*> all;
  for (Mlp<float>* network : networks)
    for (Matrix<float>* parameter : parameters(*network)) all.push_back(parameter);
  return all;
}

}  // namespace mimicx::nn
