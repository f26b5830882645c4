/// Ranks, windows and means of a series over the frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/containers.h"
#include "core/elementary.h"
#include "core/quantile.h"

namespace mimicx::motion {

/// The value of the rank that is nearest to the given share.
inline double nearest_rank(const std::vector<double>& values, double share) {
  return ranked(values, static_cast<int>(share * static_cast<double>(values.size() - 1) + 0.5));
}

/// Elements i − radius … i + radius, clipped to the ends.
inline std::vector<double> window(const PerFrame<double>& x, int i, int radius) {
  return {x.begin() + std::max(i - radius, 0), x.begin() + std::min(i + radius + 1, x.count())};
}

template <class Reduce>
PerFrame<double> sliding(const PerFrame<double>& x, int radius, const Reduce& reduce) {
  PerFrame<double> out;
  for (int i = 0; i < x.count(); ++i) out.push_back(reduce(window(x, i, radius)));
  return out;
}

/// Means under a Gaussian of standard deviation `sigma` (frames), normalised where the ends cut it.
inline PerFrame<double> smoothed(const PerFrame<double>& x, double sigma) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  PerFrame<double> out(x.size());
  for (int i = 0; i < x.count(); ++i) {
    double sum = 0.0, weights = 0.0;
    for (int k = std::max(0, i - radius); k <= std::min(x.count() - 1, i + radius); ++k) {
      const double u = (k - i) / sigma, weight = exp(-0.5 * u * u);
      sum += weight * x[k];
      weights += weight;
    }
    out[i] = sum / weights;
  }
  return out;
}

}  // namespace mimicx::motion
