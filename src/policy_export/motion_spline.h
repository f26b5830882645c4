/// The motion that a policy follows, small: B-splines with 16-bit coefficients.
///
/// A planned motion is 160 numbers per frame (91 of places and quaternions, 69 of velocities), 640 bytes: in
/// five seconds a quarter of what the network takes. But it moves little within a fifteenth of a second, and
/// its velocities are nearly the derivatives of its places. So 62 coordinates (runtime.h) become uniform
/// cubic B-splines of 16-bit coefficients, and what the velocities are more than the splines' own, 8-bit
/// numbers. All are numbers over the range that they have in this motion.
#pragma once

#include <cstdint>
#include <vector>

#include "core/containers.h"
#include "physics/data.h"
#include "policy_export/runtime.h"

namespace mimicx::policy_export {

struct MotionSpline {
  int frames = 0, spacing = 1;  ///< frames from knot to knot
  double fps = 30.0;
  std::vector<std::int16_t> knots;  ///< [(frames − 2) / spacing + 4][kChannels]
  std::vector<float> middle, step;  ///< [kChannels] a coefficient is middle + step · knot
  std::vector<std::int8_t> speeds;  ///< [frames][kSpeeds]
  std::vector<float> speed_step;    ///< [kSpeeds] a velocity is the spline's + speed_step · speed

  Motion view() const {
    return {frames, spacing, fps, knots.data(), middle.data(), step.data(), speeds.data(), speed_step.data()};
  }
};

/// @param states   at least 2
/// @param spacing  ≥ 1
/// @throws std::invalid_argument for fewer states or less spacing, or a joint that turns by nearly 360°,
/// where
///         its coordinates have no value
MotionSpline fit_spline(const List<physics::State<double>>& states, double fps, int spacing);

/// The states of a spline, rounded to float as the simulator's are.
List<physics::State<double>> states_of(const MotionSpline& spline);

physics::State<double> to_physics(const State& state);

}  // namespace mimicx::policy_export
