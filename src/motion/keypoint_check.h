/// Keypoints and cameras looked at like motions: what cannot be pixels, confidences or a camera is refused in
/// one line that says what was expected; what is clear is put right, and said.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::motion {

/// Confidences of 0 to 100 are divided by 100, those little over 1 are 1; single points that are far out of
/// every picture count as not detected.
/// @param decisions  gets a line for everything that was put right
/// @throws DataError for names that are given twice, coordinates that are no pixels, focal lengths that are
/// not positive, and extrinsics that are no rotation and translation
void check_keypoints(const std::string& path, Keypoints& keypoints, std::vector<std::string>& decisions);

}  // namespace mimicx::motion
