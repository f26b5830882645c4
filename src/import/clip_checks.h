/// Checks of a clip for content that is no motion: calibration poses, jumps, invalid angles, a camera that
/// does not look at the person. Each is reported, and repaired where the repair is obvious.
///
/// What it does not do: axes, units and frame rate (plausibility.h), keypoints (motion/keypoint_check.h).
#pragma once

#include <string>

#include "motion/clip.h"

namespace mimicx::import {

/// Replaces invalid angles (over 100 rad) by those of the frame before, with a warning.
/// @throws DataError where half of the frames have angles over two turns: the file is not in radians
void repair_angles(const std::string& path, motion::Clip& clip);

/// Removes the T-pose at the start of a clip, and the transition out of it, where the transition is faster
/// than a human can move.
void remove_t_pose(motion::Clip& clip);

/// Warns of steps of the whole body that no human makes.
void warn_of_jumps(motion::Clip& clip);

/// @throws DataError where the person is behind the camera of a clip with keypoints in most frames
void require_in_view(const std::string& path, const motion::Clip& clip);

}  // namespace mimicx::import
