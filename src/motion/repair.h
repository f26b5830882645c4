/// Steps of reference preparation that change a motion: bridging of glitches and alignment with the floor.
/// Each is a function of plain data, so that it can be tested alone; prepare.cpp strings them together.
///
/// What they do not do: no retargeting, no smoothing of the motion, no model of stairs or slopes.
#pragma once

#include "motion/clip.h"

namespace mimicx {

/// Frames of an estimator's glitch: a short stretch (at most a third of a second) between two jumps that no
/// human makes (a joint at more than 12 m/s or turning at more than 25 rad/s, and three times faster than the
/// motion around it), such that the motion is plausible without it. A glitch that touches either end of
/// the clip may have one jump only.
PerFrame<bool> find_glitches(const Clip& clip);

/// Replaces the flagged frames by interpolation between their neighbours; at the ends by the nearest sound
/// frame. A clip without a sound frame stays as it is.
void bridge_glitches(Clip& clip, const PerFrame<bool>& flagged);

struct FloorCorrection {
  double shift = 0;         ///< m, the static part
  PerFrame<double> height;  ///< m to add to every frame, static part included
};

/// Heights that put a motion on the floor, from the height of its lowest surface point per frame (m).
/// A static shift first; then the support height (a low percentile over 1.2 s, so that a flight does not
/// count) is brought to the floor, slowly and by at most 0.15 m; last, what is still deeper than 10 mm
/// is lifted. A jump keeps its height, because no correction looks at less than a second but the last, which
/// only acts on penetration.
/// @param known  the floor is known to be at 0: there is no static shift
FloorCorrection floor_correction(const PerFrame<double>& lowest, double fps, bool known = false);

}  // namespace mimicx
