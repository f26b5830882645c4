/// The sets of 2D keypoints that the program knows, and what their points are called.
#pragma once

#include <string>
#include <vector>

namespace mimicx::motion {

/// The 22 joints in the order of `Body`, or the 17 points of COCO.
enum class KeypointSet { kJoints22, kCoco17 };

/// Names of a set in file order. Points that are joints of ours have the joints' names.
std::vector<std::string> keypoint_names(KeypointSet set);

}  // namespace mimicx::motion
