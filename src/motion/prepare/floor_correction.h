/// The step of preparation (prepare.h) that puts a motion on the floor z = 0, or on the ground of its scene.
///
/// What it does not do: no slopes.
#pragma once

#include "core/containers.h"

namespace mimicx::motion {

struct FloorCorrection {
  double shift = 0;         ///< the constant part, m
  PerFrame<double> height;  ///< height to add to every frame, constant part included, m
};

/// Heights that put a motion on the floor, in three steps:
///   1. a constant shift brings the 25th percentile of all heights to 0;
///   2. a slow change of at most 0.15 m brings the height of the support to 0, which is the 25th percentile
///      over 1.2 s, so that flights do not count;
///   3. frames that are still deeper than 10 mm are lifted smoothly.
/// Jumps keep their height: the first two steps average over more than a second, and the third only removes
/// penetration.
/// @param lowest  height of the lowest surface point over the ground per frame, m
/// @param lifted  the same of the points that step 3 lifts
/// @param known   the floor is known to be at 0: no constant shift
FloorCorrection floor_correction(const PerFrame<double>& lowest, const PerFrame<double>& lifted, double fps,
                                 bool known);
/// The same where step 3 lifts every point.
inline FloorCorrection floor_correction(const PerFrame<double>& lowest, double fps, bool known = false) {
  return floor_correction(lowest, lowest, fps, known);
}

/// The third step alone: heights to add.
PerFrame<double> lift_over_floor(const PerFrame<double>& lowest, double fps);

}  // namespace mimicx::motion
