/// White noise in a series, separated from its smooth motion.         docs/method.md, "Keypoint fit", (8)
#pragma once

#include <cmath>
#include <vector>

#include "core/quantile.h"

namespace mimicx::fit {

/// Standard deviation of the white noise in a series; 0 for an empty one.
/// @param third_differences  absolute third differences of the series
inline double jitter_of(const std::vector<double>& third_differences) {
  constexpr double kMedianToSigma = 1.4826;  // of a normal distribution
  constexpr double kThirdDifference = 20.0;  // variance of a third difference of white noise of variance 1
  if (third_differences.empty()) return 0.0;
  return kMedianToSigma * median(third_differences) / std::sqrt(kThirdDifference);
}

}  // namespace mimicx::fit
