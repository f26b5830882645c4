/// What a file may hold that no motion is: poses of a calibration, jumps, angles that are none, a camera that
/// does not look at the person. Each is said, and repaired where it is clear what was meant.
///
/// What it does not do: axes, units and frame rate (plausibility.h), keypoints (motion/keypoint_check.h).
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// Replaces angles that are none (over 100 rad) by those of the frame before, with a warning that names them.
/// @throws DataError where half of the frames have angles over two turns: the file is not in radians
void mend_angles(const std::string& path, motion::Clip& clip);

/// Leaves out the T-pose that a clip starts with, and the way out of it, where that is faster than any human.
void leave_out_t_pose(motion::Clip& clip);

/// Warns of steps of the whole body that no human makes.
void name_jumps(motion::Clip& clip);

/// @throws DataError where the camera of a clip with keypoints has the person behind it in most frames
void require_in_view(const std::string& path, const motion::Clip& clip);

}  // namespace mimicx::import
