/// Scalar functions of time for the synthetic motions: quintic pieces between knots.
///
/// Between knots with zero velocity and acceleration this is the minimum-jerk blend 10s³ − 15s⁴ + 6s⁵
/// (Flash and Hogan, J. Neurosci. 5, 1985); in general the unique quintic through value, velocity and
/// acceleration of both ends, so a track is twice continuously differentiable everywhere.
#pragma once

#include <vector>

#include "core/containers.h"

namespace mimicx::synth {

struct Knot {
  double time;  ///< s
  double value;
  double velocity = 0.0;      ///< per s
  double acceleration = 0.0;  ///< per s²
};

/// Constant before the first and after the last knot.
class MinJerkTrack {
 public:
  MinJerkTrack() = default;
  /// @param knots  in any order. @throws std::invalid_argument when empty or when two share a time
  explicit MinJerkTrack(std::vector<Knot> knots);
  double at(double time) const;

 private:
  std::vector<Knot> knots_ = {{0.0, 0.0}};
};

/// `values` filtered by a Gaussian of `sigma` frames; the ends are continued by their last value.
PerFrame<double> smoothed(const PerFrame<double>& values, double sigma);

}  // namespace mimicx::synth
