/// Change of a clip's frame rate.
///
/// What it does not do: no low-pass filter before downsampling, no change of the motion's speed.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// The clip at another frame rate (Hz), starting at its first frame. Rotations are interpolated by slerp;
/// positions, keypoints and cameras linearly. A clip of that rate is returned unchanged. A keypoint that is
/// detected in only one of two frames is taken from the nearer frame. Passed-through members: passthrough.h.
/// @throws std::invalid_argument unless the rate is positive, DataError for more than 300,000 frames
Clip resampled(const Clip& clip, double fps);

}  // namespace mimicx::motion
