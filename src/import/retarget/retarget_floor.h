/// The last steps of retargeting: soles level, feet on the floor.
#pragma once

#include "import/retarget/retarget_solve.h"
#include "motion/clip.h"

namespace mimicx::import {

/// Removes the constant error of the calibration from the soles. While a foot stands its sole is level, so
/// the median direction of "up" in the foot's frame shows the error. The third of its standing frames with
/// the lowest ankle counts, because heels come up while the ball still stands. Where the neutral pose is a
/// stance, the error is the skeleton's and the same on both feet, mirrored; errors that differ stay, and so
/// do errors of more than 30°. Elsewhere each foot has an error of its own, up to 60°. `calibration` changes;
/// `clip` gets a decision for each foot and must be solved again.
/// @param neutral_stands  the neutral pose is a stance
void level_soles(bool neutral_stands, Calibration& calibration, motion::Clip& clip);

/// Moves the clip onto the floor z = 0. Over the frames in which a foot stands, the median of the height of
/// the lowest foot point becomes 0. Where hardly any foot ever stands, 5 % of the frames stay below the
/// floor.
/// @return by how much, m
double put_on_floor(motion::Clip& clip);

}  // namespace mimicx::import
