/// The known sets of 2D keypoints: the names of their points and their positions on the body.
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

/// The set with this number of points; empty where there is none.
std::optional<KeypointSet> keypoint_set_of(std::size_t points);

/// The name with left and right exchanged; a name without a side is returned unchanged.
std::string mirrored_name(const std::string& name);

/// The position of a keypoint on the body.
struct KeypointPlace {
  int body = 0;
  int first = 0, last = -1;  ///< sole points whose mean it lies above; none: it lies at the joint
  double above = 0.0;        ///< height above that mean, in the body's frame, m
};
/// The name that the program has for a keypoint, whatever its spelling: of "LEFT_HIP", "left hip", "LeftHip",
/// and of OpenPose's "LHip" and "MidHip". A name that is none of ours in any spelling stays as it is.
std::string known_keypoint_name(const std::string& name);

/// For joints, heels, big and small toes; empty for other names (face, fingers, unknown points).
std::optional<KeypointPlace> place_of_keypoint(const std::string& name);

/// The keypoint's position in the frame of its body, m.
Vector3d place_on(const Character& character, const KeypointPlace& place);

}  // namespace mimicx::motion
