/// Our own exp, the activation elu over arrays, and sums with a defined order.
///
/// The standard library's functions give different bits on different CPUs, and Eigen's differ between the
/// vectorised body of a row and its tail. These use + − · / and bit shifts only, without fused operations:
/// the compiler may vectorise them at any width, and the bits of an element do not depend on its place.
///
/// The method of the exponential is that of core/exponential.h.
/// Error against the exact value, in units in the last place: exp 2, expm1 3 (tested).
/// exp saturates at |x| = 87 (float) and 708 (double) instead of overflowing or underflowing. NaN stays NaN.
#pragma once

#include "core/exponential.h"
#include "nn/matrix.h"

namespace mimicx::nn {

template <class S>
struct ActivationLimits;
template <>
struct ActivationLimits<float> {
  static constexpr float kExp = 87.0f;
};
template <>
struct ActivationLimits<double> {
  static constexpr double kExp = 708.0;
};

/// e^x = scale · (1 + fraction), scale a power of two.
template <class S>
struct ExpParts {
  S scale, fraction;
};

template <class S>
inline ExpParts<S> exp_parts(S x) {
  constexpr S kLimit = ActivationLimits<S>::kExp;
  x = x < -kLimit ? -kLimit : x;
  x = x > kLimit ? kLimit : x;
  const auto [n, fraction] = reduced_exp(x);
  return {power_of_two<S>(n), fraction};
}

template <class S>
inline S exp_value(S x) {
  const auto [scale, fraction] = exp_parts(x);
  return scale + scale * fraction;
}

/// e^x − 1, accurate near 0.
template <class S>
inline S expm1_value(S x) {
  const auto [scale, fraction] = exp_parts(x);
  return (scale - S(1)) + scale * fraction;
}

/// x for x > 0, otherwise e^x − 1: the sum of both branches, one of which is 0.
template <class S>
inline S elu_value(S x) {
  const S negative = x < S(0) ? x : S(0);
  const S positive = x < S(0) ? S(0) : x;
  return positive + expm1_value(negative);
}

/// y = elu(x); y may be x.
template <class S>
void apply_elu(const Matrix<S>& x, Matrix<S>& y);
/// result = g · elu'(x). The slope is a function of y = elu(x) alone, so a layer stores y and nothing else.
template <class S>
void multiply_by_elu_slope(const Matrix<S>& g, const Matrix<S>& y, Matrix<S>& result);
/// y = e^x, resized.
template <class S>
void apply_exp(const Matrix<S>& x, Matrix<S>& y);

/// Sum of n contiguous numbers: 16 interleaved partial sums, then pairwise.
template <class S>
S ordered_sum(const S* x, Eigen::Index n);
/// [n, m] → [1, m], rows added in order.
template <class S>
void sum_rows(const Matrix<S>& x, Matrix<S>& row);

}  // namespace mimicx::nn
