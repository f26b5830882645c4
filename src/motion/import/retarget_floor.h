/// The last steps of retargeting: soles level, feet on the floor.
#pragma once

#include "motion/clip.h"
#include "motion/import/retarget_solve.h"

namespace mimicx {

/// While a foot stands its sole is level: the median "up" in its frame, over the third of its standing frames
/// with the lowest ankle (heels come up while the ball still stands), shows the constant error of the
/// calibration. Where the neutral pose is a stance, the error is the skeleton's: then it is the same on both
/// feet, mirrored, and what is not stays; at most 30°. Else each foot has its own, at most 60°. `clip` must
/// be solved again.
/// @param neutral_stands  the neutral pose is a stance
void level_soles(bool neutral_stands, Calibration& calibration, Clip& clip);

/// Moves the clip to where the lowest point of feet that stand is on the floor z = 0 (median over the frames
/// in which one does); where none ever stands, to where all but the lowest 5 % of the frames have nothing
/// under the floor.
/// @return by how much, m
double put_on_floor(Clip& clip);

}  // namespace mimicx
