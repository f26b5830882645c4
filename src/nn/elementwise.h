/// Our own exp and tanh, activation functions over arrays, and sums with a defined order.
///
/// The standard library's functions give different bits on different CPUs, and Eigen's differ between the
/// vectorised body of a row and its tail. These are made of + − · / and bit shifts only, without fused
/// operations: the compiler may vectorise them at any width and every element keeps its bits, wherever
/// it stands.
///
/// Method: x = n·ln 2 + r with |r| ≤ ½ ln 2 (Cody and Waite's two-part ln 2), the Taylor series of
/// e^r − 1 (degree 7 for float, 13 for double: truncation below half a unit in the last place), then a
/// multiplication by 2ⁿ put together from bits.
/// Error against the exact value, in units in the last place: exp 2, expm1 3, tanh 4 (tested).
/// exp saturates at |x| = 87 (float) and 708 (double) instead of overflowing or underflowing. NaN stays NaN.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "nn/activation.h"
#include "nn/matrix.h"

namespace mimicx::nn {

template <class S>
struct ExpConstants;

template <>
struct ExpConstants<float> {
  using Bits = std::int32_t;
  static constexpr float kLimit = 87.0f;
  static constexpr float kRound = 12582912.0f;     ///< 1.5·2²³: adding it rounds to an integer
  static constexpr float kLn2High = 0.693359375f;  ///< 9 bits, exact when multiplied by n
  static constexpr float kLn2Low = -2.12194440e-4f;
  static constexpr int kMantissaBits = 23;
  static constexpr Bits kBias = 127;
  static constexpr std::size_t kDegree = 7;
  static constexpr float kTanhLimit = 10.0f;  ///< tanh is 1 from here on
};

template <>
struct ExpConstants<double> {
  using Bits = std::int64_t;
  static constexpr double kLimit = 708.0;
  static constexpr double kRound = 6755399441055744.0;  ///< 1.5·2⁵²
  static constexpr double kLn2High = 6.93145751953125e-1;
  static constexpr double kLn2Low = 1.42860682030941723212e-6;
  static constexpr int kMantissaBits = 52;
  static constexpr Bits kBias = 1023;
  static constexpr std::size_t kDegree = 13;
  static constexpr double kTanhLimit = 20.0;
};

/// e^x = scale · (1 + fraction), scale a power of two.
template <class S>
struct ExpParts {
  S scale, fraction;
};

/// [k] = 1/k!
template <class S>
constexpr auto inverse_factorials() {
  std::array<S, ExpConstants<S>::kDegree + 1> result{S(1)};
  double factorial = 1;
  for (std::size_t k = 1; k < result.size(); ++k) {
    factorial *= static_cast<double>(k);
    result[k] = static_cast<S>(1.0 / factorial);
  }
  return result;
}

template <class S>
inline ExpParts<S> exp_parts(S x) {
  using Constants = ExpConstants<S>;
  x = x < -Constants::kLimit ? -Constants::kLimit : x;
  x = x > Constants::kLimit ? Constants::kLimit : x;
  const S shifted = x * S(1.44269504088896340736) + Constants::kRound;
  const S n = shifted - Constants::kRound;
  const S r = (x - n * Constants::kLn2High) - n * Constants::kLn2Low;
  constexpr auto kInverseFactorial = inverse_factorials<S>();
  S tail = kInverseFactorial[Constants::kDegree];
  for (std::size_t k = Constants::kDegree - 1; k >= 2; --k) tail = tail * r + kInverseFactorial[k];
  using Bits = typename Constants::Bits;
  const Bits exponent =
      std::bit_cast<Bits>(shifted) - std::bit_cast<Bits>(Constants::kRound) + Constants::kBias;
  return {std::bit_cast<S>(exponent << Constants::kMantissaBits), r + r * r * tail};
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

/// tanh x = e/(e + 2), e = e^{2x} − 1, on |x|: odd symmetry is exact.
template <class S>
inline S tanh_value(S x) {
  const S limit = ExpConstants<S>::kTanhLimit;
  const S magnitude = std::abs(x) > limit ? limit : std::abs(x);
  const S e = expm1_value(S(2) * magnitude);
  return std::copysign(e / (e + S(2)), x);
}

/// x where x > 0, else e^x − 1: the sum of the two sides, one of which is 0.
template <class S>
inline S elu_value(S x) {
  const S negative = x < S(0) ? x : S(0);
  const S positive = x < S(0) ? S(0) : x;
  return positive + expm1_value(negative);
}

/// y = φ(x); y may be x.
template <class S>
void apply_activation(Activation activation, const Matrix<S>& x, Matrix<S>& y);
/// result = g · φ'(x), with φ' expressed by y = φ(x).
template <class S>
void multiply_by_slope(Activation activation, const Matrix<S>& g, const Matrix<S>& y, Matrix<S>& result);
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
