#include "motion/keypoint_names.h"

#include "character/character.h"

namespace mimicx::motion {

std::vector<std::string> keypoint_names(KeypointSet set) {
  if (set == KeypointSet::kJoints22) return {kBodyNames.begin(), kBodyNames.end()};
  return {"nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
          "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
          "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};
}

}  // namespace mimicx::motion
