/// The sets of 2D keypoints that the program knows, what their points are called, and where on the body they
/// are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "character/character.h"

namespace mimicx::motion {

/// The 22 joints in the order of `Body`, the 17 points of COCO, or the 133 of COCO-WholeBody: those 17, then
/// six of the feet, 68 of the face, 21 of each hand.
enum class KeypointSet { kJoints22, kCoco17, kCoco133 };

/// Names of a set in file order. Points that are joints of ours have the joints' names.
std::vector<std::string> keypoint_names(KeypointSet set);

/// The set of so many points. Empty: there is none.
std::optional<KeypointSet> keypoint_set_of(std::size_t points);

/// The name with left and right exchanged; the name itself where it has no side.
std::string mirrored_name(const std::string& name);

/// Where on the body a keypoint is.
struct KeypointPlace {
  int body = 0;
  int first = 0, last = -1;  ///< it is above the middle of these points of the soles; none: at the joint
  double above = 0.0;        ///< m, in the body's frame
};
/// Joints, heels, big and small toes. Empty for other names (face, fingers, strangers).
std::optional<KeypointPlace> place_of_keypoint(const std::string& name);

/// In the frame of its body, m.
Vector3d place_on(const Character& character, const KeypointPlace& place);

}  // namespace mimicx::motion
