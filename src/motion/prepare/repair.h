/// Steps of reference preparation that change a motion: bridging of glitches and alignment with the floor.
/// Each is a function of plain data, so that it can be tested alone; prepare.cpp strings them together.
///
/// What they do not do: no retargeting, no smoothing of the motion, no model of stairs or slopes.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// Frames of an estimator's glitches. A glitch is a stretch of at most a third of a second between two jumps;
/// without it the motion is plausible. A jump is a step that no human makes: a joint moves at more than
/// 12 m/s or turns at more than 25 rad/s, three times faster than the motion around it. A glitch that touches
/// either end of the clip has one jump and lasts a sixth of a second at most.
PerFrame<bool> find_glitches(const Clip& clip);

/// Replaces the flagged frames by interpolation between their neighbours; at the ends by the nearest sound
/// frame. A clip without a sound frame stays as it is.
void bridge_glitches(Clip& clip, const PerFrame<bool>& flagged);

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
