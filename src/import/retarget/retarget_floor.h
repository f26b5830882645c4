/// The last steps of retargeting: soles level, feet on the floor.
#pragma once

#include "import/retarget/retarget_solve.h"
#include "motion/clip.h"

namespace mimicx::import {

/// Removes the constant error of the calibration from the soles. The sole of a standing foot is level, so the
/// median direction of "up" in the foot's frame shows the error. Only the third of the standing frames with
/// the lowest ankle counts, because the heel rises while the ball still stands. If the neutral pose is a
/// stance, the error belongs to the skeleton and is mirrored on the other foot; errors that differ between
/// the feet or exceed 30° are kept. Otherwise each foot has its own error, up to 60°. `calibration` changes;
/// `clip` gets a decision for each foot, and its poses must be computed again.
/// @param neutral_stands  the neutral pose is a stance
/// @param least           smaller errors are kept, rad
void level_soles(bool neutral_stands, double least, Calibration& calibration, motion::Clip& clip);

/// Rolls standing feet about the line from ankle to toes until their soles are level across, by at most 30°,
/// and eases the roll in and out within 0.15 s. For motions from joint positions, which do not show the roll:
/// feet then have none against the shank, although knees bend in other directions than toes point.
void level_rolls(const Character& character, motion::Clip& clip);

/// Moves the clip onto the floor z = 0: the median height of the lowest foot point over the frames with a
/// standing foot becomes 0. Where feet hardly ever stand, 5 % of the frames stay below the floor.
/// @param rigid_toes  toes do not bend, and dip as the heel rises: only the third of the standing frames with
///                    the lowest ankle counts
/// @return height added, m
double put_on_floor(bool rigid_toes, motion::Clip& clip);

/// Extends toes that reach below the floor z = 0 until they lie on it, by at most 60°.
void extend_toes(motion::Clip& clip);

/// Hands that never turn against their forearms were not recorded; they lie in the forearm's line and pierce
/// the floor where a person pushes with the palms. Bends each such hand at the wrist, by at most 90°, until
/// it lies on the floor z = 0. `clip` gets a decision.
void bend_hands(motion::Clip& clip);

}  // namespace mimicx::import
