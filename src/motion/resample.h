/// Change of a clip's frame rate.
///
/// What it does not do: no filter before frames are left out, no stretching of the motion in time.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// The clip at another frame rate (Hz), from its first frame on: rotations by slerp, positions, keypoints and
/// cameras linearly. A clip of that rate comes back unchanged. A keypoint that is seen in one of two frames
/// alone is that of the nearer frame. Passed-through members follow as passthrough.h says.
/// @throws std::invalid_argument unless the rate is positive, DataError where frames would be made by the
/// hundred thousand
Clip resampled(const Clip& clip, double fps);

}  // namespace mimicx::motion
