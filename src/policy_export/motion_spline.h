/// Compresses the motion that a policy follows: B-splines with 16-bit coefficients.
///
/// A planned motion has 160 numbers per frame (91 for positions and quaternions, 69 for velocities), 640
/// bytes: five seconds take a quarter of the network's size. It changes little within a fifteenth of a
/// second, and its velocities are nearly the derivatives of its positions. Therefore 62 coordinates
/// (runtime.h) are stored as uniform cubic B-splines with 16-bit coefficients, and the differences of the
/// velocities from the splines' derivatives as 8-bit numbers. All are scaled to their range in this motion.
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
/// @throws std::invalid_argument for fewer states, a smaller spacing, or a joint that turns by nearly 360°,
/// where its coordinates are undefined
MotionSpline fit_spline(const List<physics::State<double>>& states, double fps, int spacing);

/// The states of a spline, rounded to float as those of the simulator.
List<physics::State<double>> states_of(const MotionSpline& spline);

physics::State<double> to_physics(const State& state);

}  // namespace mimicx::policy_export
