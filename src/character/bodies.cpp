#include "character/bodies.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"

namespace mimicx {

const PerBody<std::string_view> kBodyNames = {
    "pelvis",     "left_hip",    "right_hip",    "spine1",     "left_knee",     "right_knee",
    "spine2",     "left_ankle",  "right_ankle",  "spine3",     "left_foot",     "right_foot",
    "neck",       "left_collar", "right_collar", "head",       "left_shoulder", "right_shoulder",
    "left_elbow", "right_elbow", "left_wrist",   "right_wrist"};

int body_of_name(std::string_view name) {
  const auto found = std::find(kBodyNames.begin(), kBodyNames.end(), name);
  return found == kBodyNames.end() ? -1 : static_cast<int>(found - kBodyNames.begin());
}

Vector3d hinge_axis(int body) {
  switch (body) {
    case kLeftKnee:
    case kRightKnee:
      return Vector3d::UnitX();
    case kLeftElbow:
      return -Vector3d::UnitY();
    case kRightElbow:
      return Vector3d::UnitY();
    default:
      raise(std::invalid_argument("hinge_axis: body has no hinge"));
  }
}

bool is_right(int body) { return kBodyNames[body].starts_with("right"); }

}  // namespace mimicx
