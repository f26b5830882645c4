#include "nn/elementwise.h"

#include <array>

namespace mimicx::nn {

namespace {

/// y[i] = f(x[i]) over contiguous memory: the loop the compiler vectorises.
template <class S, class F>
void map_unary(const Matrix<S>& x, Matrix<S>& y, F f) {
  const S* in = x.data();
  S* out = y.data();
  const Eigen::Index n = x.size();
  for (Eigen::Index i = 0; i < n; ++i) out[i] = f(in[i]);
}

template <class S, class F>
void map_binary(const Matrix<S>& a, const Matrix<S>& b, Matrix<S>& y, F f) {
  const S* left = a.data();
  const S* right = b.data();
  S* out = y.data();
  const Eigen::Index n = a.size();
  for (Eigen::Index i = 0; i < n; ++i) out[i] = f(left[i], right[i]);
}

}  // namespace

template <class S>
void apply_activation(Activation activation, const Matrix<S>& x, Matrix<S>& y) {
  switch (activation) {
    case Activation::kLinear:
      map_unary(x, y, [](S v) { return v; });
      break;
    case Activation::kRelu:
      map_unary(x, y, [](S v) { return v < S(0) ? S(0) : v; });
      break;
    case Activation::kElu:
      map_unary(x, y, [](S v) { return elu_value(v); });
      break;
    case Activation::kTanh:
      map_unary(x, y, [](S v) { return tanh_value(v); });
      break;
  }
}

template <class S>
void multiply_by_slope(Activation activation, const Matrix<S>& g, const Matrix<S>& y, Matrix<S>& result) {
  switch (activation) {
    case Activation::kLinear:
      map_unary(g, result, [](S v) { return v; });
      break;
    case Activation::kRelu:
      map_binary(g, y, result, [](S v, S out) { return out > S(0) ? v : S(0); });
      break;
    case Activation::kElu:
      map_binary(g, y, result, [](S v, S out) { return v * ((out < S(0) ? out : S(0)) + S(1)); });
      break;
    case Activation::kTanh:
      map_binary(g, y, result, [](S v, S out) { return v * (S(1) - out * out); });
      break;
  }
}

template <class S>
void apply_exp(const Matrix<S>& x, Matrix<S>& y) {
  map_unary(x, y, [](S v) { return exp_value(v); });
}

template <class S>
S ordered_sum(const S* x, Eigen::Index n) {
  constexpr int kLanes = 16;
  std::array<S, kLanes> partial{};
  Eigen::Index i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (int lane = 0; lane < kLanes; ++lane) partial[static_cast<std::size_t>(lane)] += x[i + lane];
  for (int lane = 0; i < n; ++i, ++lane) partial[static_cast<std::size_t>(lane)] += x[i];
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t lane = 0; lane < half; ++lane)
      partial[static_cast<std::size_t>(lane)] += partial[lane + half];
  return partial[0];
}

template <class S>
void sum_rows(const Matrix<S>& x, Matrix<S>& row) {
  row.setZero();
  S* out = row.data();
  const Eigen::Index cols = x.cols();
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const S* in = x.data() + i * cols;
    for (Eigen::Index j = 0; j < cols; ++j) out[j] += in[j];
  }
}

#define MIMICX_INSTANTIATE(S)                                                                  \
  template void apply_activation(Activation, const Matrix<S>&, Matrix<S>&);                    \
  template void multiply_by_slope(Activation, const Matrix<S>&, const Matrix<S>&, Matrix<S>&); \
  template void apply_exp(const Matrix<S>&, Matrix<S>&);                                       \
  template S ordered_sum(const S*, Eigen::Index);                                              \
  template void sum_rows(const Matrix<S>&, Matrix<S>&);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
