/// Checks keypoints and cameras of a file. Values that cannot be pixels, confidences or a camera are errors.
/// Mistakes with an obvious meaning, such as confidences in percent, are corrected and reported.
#pragma once

#include <string>
#include <vector>

#include "motion/clip.h"

namespace mimicx::motion {

/// Divides confidences of 0 to 100 by 100, lowers confidences slightly above 1 to 1, and marks single points
/// far outside of any picture as not detected.
/// @param decisions  gets a line for every correction
/// @throws DataError for repeated names, coordinates that are not pixels, focal lengths that are not
/// positive, and extrinsics that are not a rotation and a translation
void check_keypoints(const std::string& path, Keypoints& keypoints, std::vector<std::string>& decisions);

}  // namespace mimicx::motion
