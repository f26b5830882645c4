/// Ranks and windows of a series over the frames.
#pragma once

#include <algorithm>
#include <vector>

#include "core/containers.h"
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

}  // namespace mimicx::motion
