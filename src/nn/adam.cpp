#include "nn/adam.h"

#include <cmath>
#include <stdexcept>

#include "core/error.h"

namespace mimicx::nn {

template <class S>
Adam<S> make_adam(std::span<Matrix<S>* const> parameters) {
  Adam<S> adam;
  for (const Matrix<S>* parameter : parameters) {
    adam.first.push_back(Matrix<S>::Zero(parameter->rows(), parameter->cols()));
    adam.second.push_back(adam.first.back());
  }
  return adam;
}

template <class S>
void adam_step(Adam<S>& adam, std::span<Matrix<S>* const> parameters, std::span<const Matrix<S>> gradients,
               S step_size) {
  if (parameters.size() != gradients.size() || parameters.size() != adam.first.size())
    raise(std::invalid_argument("adam_step: parameters, gradients and moments differ in number"));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    for (const Matrix<S>* other : {&gradients[k], static_cast<const Matrix<S>*>(&adam.first[k])})
      if (parameters[k]->rows() != other->rows() || parameters[k]->cols() != other->cols())
        raise(std::invalid_argument("adam_step: a parameter and its gradient or moments differ in shape"));

  ++adam.steps;
  adam.beta1_power *= double(adam.beta1);
  adam.beta2_power *= double(adam.beta2);
  const S first_correction = static_cast<S>(1.0 / (1.0 - adam.beta1_power));
  const S second_correction = static_cast<S>(1.0 / (1.0 - adam.beta2_power));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const S* g = gradients[k].data();
    S* m = adam.first[k].data();
    S* v = adam.second[k].data();
    S* x = parameters[k]->data();
    for (Eigen::Index i = 0; i < parameters[k]->size(); ++i) {
      m[i] = adam.beta1 * m[i] + (S(1) - adam.beta1) * g[i];
      v[i] = adam.beta2 * v[i] + (S(1) - adam.beta2) * (g[i] * g[i]);
      x[i] -= step_size * (m[i] * first_correction) / (std::sqrt(v[i] * second_correction) + adam.epsilon);
    }
  }
}

template <class S>
double gradient_norm(std::span<const Matrix<S>> gradients) {
  double squares = 0;
  for (const Matrix<S>& gradient : gradients)
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      const double value = gradient.data()[i];
      squares += value * value;
    }
  return std::sqrt(squares);
}

template <class S>
double clip_gradient_norm(std::span<Matrix<S>> gradients, double max_norm) {
  const double norm = gradient_norm<S>(gradients);
  if (norm > max_norm)
    for (Matrix<S>& gradient : gradients) gradient *= static_cast<S>(max_norm / norm);
  return norm;
}

#define MIMICX_INSTANTIATE(S)                                                                    \
  template Adam<S> make_adam(std::span<Matrix<S>* const>);                                       \
  template void adam_step(Adam<S>&, std::span<Matrix<S>* const>, std::span<const Matrix<S>>, S); \
  template double gradient_norm(std::span<const Matrix<S>>);                                     \
  template double clip_gradient_norm(std::span<Matrix<S>>, double);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
