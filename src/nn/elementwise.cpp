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

}  // namespace

template <class S>
void apply_elu(const Matrix<S>& x, Matrix<S>& y) {
  map_unary(x, y, [](S v) { return elu_value(v); });
}

template <class S>
void multiply_by_elu_slope(const Matrix<S>& g, const Matrix<S>& y, Matrix<S>& result) {
  const S* left = g.data();
  const S* value = y.data();
  S* out = result.data();
  const Eigen::Index n = g.size();
  for (Eigen::Index i = 0; i < n; ++i) out[i] = left[i] * ((value[i] < S(0) ? value[i] : S(0)) + S(1));
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

#define MIMICX_INSTANTIATE(S)                                                          \
  template void apply_elu(const Matrix<S>&, Matrix<S>&);                               \
  template void multiply_by_elu_slope(const Matrix<S>&, const Matrix<S>&, Matrix<S>&); \
  template void apply_exp(const Matrix<S>&, Matrix<S>&);                               \
  template S ordered_sum(const S*, Eigen::Index);                                      \
  template void sum_rows(const Matrix<S>&, Matrix<S>&);
MIMICX_INSTANTIATE(float)
MIMICX_INSTANTIATE(double)
#undef MIMICX_INSTANTIATE

}  // namespace mimicx::nn
