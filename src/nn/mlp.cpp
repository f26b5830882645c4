#include "nn/mlp.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "nn/elementwise.h"
#include "nn/gemm.h"

namespace mimicx::nn {

template <class S>
Mlp<S> make_mlp(const std::vector<int>& sizes, S last_scale, Random& random) {
  if (sizes.size() < 2 || std::any_of(sizes.begin(), sizes.end(), [](int n) { return n < 1; }))
    raise(std::invalid_argument("make_mlp: expected at least two sizes, each at least 1"));
  Mlp<S> mlp{sizes, {}, {}};
  for (std::size_t layer = 0; layer + 1 < sizes.size(); ++layer) {
    const bool last = layer + 2 == sizes.size();
    const double gain = last ? double(last_scale) : 1.0;
    const double deviation = gain / std::sqrt(double(sizes[layer]));
    Matrix<S> weight(sizes[layer], sizes[layer + 1]);
    for (Eigen::Index i = 0; i < weight.size(); ++i)
      weight.data()[i] = static_cast<S>(deviation * random.normal());
    mlp.weights.push_back(std::move(weight));
    mlp.biases.push_back(Matrix<S>::Zero(1, sizes[layer + 1]));
  }
  return mlp;
}

template <class S>
std::vector<Matrix<S>*> parameters(Mlp<S>& mlp) {
  std::vector<Matrix<S>*> result;
  for (std::size_t layer = 0; layer < mlp.weights.size(); ++layer) {
    result.push_back(&mlp.weights[layer]);
    result.push_back(&mlp.biases[layer]);
  }
  return result;
}

template <class S>
std::vector<Var> parameters_on_tape(Tape<S>& tape, const Mlp<S>& mlp) {
  std::vector<Var> result;
  for (std::size_t layer = 0; layer < mlp.weights.size(); ++layer) {
    result.push_back(tape.refer(mlp.weights[layer]));
    result.push_back(tape.refer(mlp.biases[layer]));
  }
  return result;
}

template <class S>
Var forward(Tape<S>& tape, const Mlp<S>& mlp, std::span<const Var> parameters, Var x) {
  assert(parameters.size() == 2 * mlp.weights.size());
  for (int layer = 0; layer < mlp.layers(); ++layer) {
    const auto first = 2 * static_cast<std::size_t>(layer);
    x = affine(tape, x, parameters[first], parameters[first + 1],
               layer + 1 < mlp.layers() ? Activation::kElu : Activation::kLinear);
  }
  return x;
}

template <class S>
void evaluate(const Mlp<S>& mlp, const Matrix<S>& input, Workspace<S>& workspace, Matrix<S>& output) {
  assert(input.cols() == mlp.inputs());
  workspace.hidden.resize(mlp.weights.size() - 1);
  const Matrix<S>* x = &input;
  for (int layer = 0; layer < mlp.layers(); ++layer) {
    const auto index = static_cast<std::size_t>(layer);
    const bool last = layer + 1 == mlp.layers();
    Matrix<S>& y = last ? output : workspace.hidden[index];
    y.resize(input.rows(), mlp.weights[index].cols());
    gemm(false, false, *x, mlp.weights[index], mlp.biases[index].data(), y);
    if (!last) apply_elu(y, y);
    x = &y;
  }
}

#define MIMICX_INSTANTIATE(S)                                               \
  template Mlp<S> make_mlp(const std::vector<int>&, S, Random&);            \
  template std::vector<Matrix<S>*> parameters(Mlp<S>&);                     \
  template std::vector<Var> parameters_on_tape(Tape<S>&, const Mlp<S>&);    \
  template Var forward(Tape<S>&, const Mlp<S>&, std::span<const Var>, Var); \
  template void evaluate(const Mlp<S>&, const Matrix<S>&, Workspace<S>&, Matrix<S>&);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
