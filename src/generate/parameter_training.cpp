#include "generate/parameter_training.h"

#include "nn/gradient.h"

namespace mimicx::generate {

ParameterTraining::ParameterTraining(std::vector<nn::Matrix<float>*> parameters)
    : parameters_(std::move(parameters)), adam_(nn::make_adam<float>(parameters_)) {}

nn::Tape<float>& ParameterTraining::start() {
  tape_.reset();
  nodes_.clear();
  for (const nn::Matrix<float>* parameter : parameters_) nodes_.push_back(tape_.refer(*parameter));
  return tape_;
}

double ParameterTraining::descend(nn::Var loss, double step_size) {
  const double value = double{tape_.scalar(loss)};
  std::vector<nn::Matrix<float>> gradients;
  for (const nn::Var node : nn::gradient(tape_, loss, nodes_)) gradients.push_back(tape_.value(node));
  nn::clip_gradient_norm<float>(gradients, 1.0);
  nn::adam_step<float>(adam_, parameters_, gradients, static_cast<float>(step_size));
  return value;
}

std::vector<nn::Matrix<float>*> parameters_of(std::span<nn::Mlp<float>* const> networks) {
  std::vector<nn::Matrix<float>*> all;
  for (nn::Mlp<float>* network : networks)
    for (nn::Matrix<float>* parameter : nn::parameters(*network)) all.push_back(parameter);
  return all;
}

}  // namespace mimicx::generate
