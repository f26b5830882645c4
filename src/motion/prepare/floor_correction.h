/// The step of preparation (prepare.h) that puts a motion on the floor z = 0.
///
/// What it does not do: no model of stairs or slopes.
#pragma once

#include "core/containers.h"

namespace mimicx::motion {

struct FloorCorrection {
  double shift = 0;         ///< m, the static part
  PerFrame<double> height;  ///< m to add to every frame, static part included
};

/// Heights that put a motion on the floor, in three steps:
///   1. a static shift brings a low percentile of all heights to 0;
///   2. a slow change of at most 0.15 m brings the height of the support to 0: that is a low percentile over
///      1.2 s, so that a flight does not count;
///   3. frames that are still deeper than 10 mm are lifted, smoothly.
/// A jump keeps its height: the first two steps look at more than a second, the third at penetration alone.
/// @param lowest  height of the lowest surface point per frame, m
/// @param known   the floor is known to be at 0: there is no static shift
FloorCorrection floor_correction(const PerFrame<double>& lowest, double fps, bool known = false);

}  // namespace mimicx::motion
