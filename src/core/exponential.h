/// e^r on a short interval: the common part of the scalar exponential and the networks' activations.
///
/// Uses + − · and bit shifts only, without fused operations: the compiler may vectorise it at any width, and
/// the bits of an element depend neither on its place nor on the processor.
///
/// Method: x = n·ln 2 + r with |r| ≤ ½ ln 2 (Cody and Waite's two-part ln 2), then the Taylor series of
/// e^r − 1 (degree 7 for float, 13 for double: truncation below half a unit in the last place). The caller
/// multiplies by 2ⁿ and handles arguments whose e^x is no normal number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/bits.h"

namespace mimicx {

template <class S>
struct ExpConstants;

template <>
struct ExpConstants<float> {
  using Bits = std::int32_t;
  static constexpr float kRound = 12582912.0f;     ///< 1.5·2²³: adding it rounds to an integer
  static constexpr float kLn2High = 0.693359375f;  ///< 9 bits, exact when multiplied by n
  static constexpr float kLn2Low = -2.12194440e-4f;
  static constexpr int kMantissaBits = 23;
  static constexpr Bits kBias = 127;
  static constexpr std::size_t kDegree = 7;
};

template <>
struct ExpConstants<double> {
  using Bits = std::int64_t;
  static constexpr double kRound = 6755399441055744.0;  ///< 1.5·2⁵²
  static constexpr double kLn2High = 6.93145751953125e-1;
  static constexpr double kLn2Low = 1.42860682030941723212e-6;
  static constexpr int kMantissaBits = 52;
  static constexpr Bits kBias = 1023;
  static constexpr std::size_t kDegree = 13;
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

/// e^x = 2ⁿ · (1 + fraction).
template <class S>
struct ReducedExp {
  typename ExpConstants<S>::Bits n;
  S fraction;
};

/// @param x  finite; |x| ≤ 10³
template <class S>
inline ReducedExp<S> reduced_exp(S x) {
  using Constants = ExpConstants<S>;
  const S shifted = x * S(1.44269504088896340736) + Constants::kRound;
  const S n = shifted - Constants::kRound;
  const S r = (x - n * Constants::kLn2High) - n * Constants::kLn2Low;
  constexpr auto kInverseFactorial = inverse_factorials<S>();
  S tail = kInverseFactorial[Constants::kDegree];
  for (std::size_t k = Constants::kDegree - 1; k >= 2; --k) tail = tail * r + kInverseFactorial[k];
  using Bits = typename Constants::Bits;
  return {mimicx::bit_cast<Bits>(shifted) - mimicx::bit_cast<Bits>(Constants::kRound), r + r * r * tail};
}

/// 2ⁿ from its bits. @param n  an exponent of normal numbers
template <class S>
inline S power_of_two(typename ExpConstants<S>::Bits n) {
  using Constants = ExpConstants<S>;
  return mimicx::bit_cast<S>((n + Constants::kBias) << Constants::kMantissaBits);
}

}  // namespace mimicx
