/// Skeletons made for the tests, and BVH text evaluated in the plainest way.
#pragma once

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.h"
#include "import/retarget/skeleton.h"
#include "motion/clip.h"

namespace mimicx::test {

/// How a skeleton that moves like a clip differs from it.
struct Disguise {
  double unit = 1.0;                           ///< file units per metre
  Quaterniond axes = Quaterniond::Identity();  ///< from the world (z up) to the file's axes
  PerBody<std::string> names;
  /// [22] rest pose: world rotation of each joint in the clip's T-pose (model axes). A bone that hangs in an
  /// A-pose has the rotation that raises it; bones along x have one each.
  PerBody<Quaterniond> rest = unturned();

  static PerBody<Quaterniond> unturned() {
    PerBody<Quaterniond> rest;
    rest.fill(Quaterniond::Identity());
    return rest;
  }
};

/// The clip as a skeleton of another make would have it: joints with the same places, frames as the disguise
/// says.
inline import::SkeletonMotion disguised(const motion::Clip& clip, const Disguise& disguise) {
  const Character character = make_character(clip.usable_betas());
  import::SkeletonMotion motion;
  motion.name = clip.name;
  motion.path = "made";
  motion.fps = clip.fps;
  for (int b = 0; b < kBodies; ++b) {
    const int parent = std::max(kParents[b], 0);
    const Vector3d offset =
        b == 0 ? Vector3d::Zero()
               : Vector3d(disguise.unit * (disguise.rest[parent].conjugate() * character.joint_offset[b]));
    motion.joints.push_back({disguise.names[b], kParents[b], offset, false});
  }
  for (const BodyPoses& pose : motion::poses_of(clip)) {
    auto& translation = motion.translation.emplace_back();
    auto& rotation = motion.rotation.emplace_back();
    for (int b = 0; b < kBodies; ++b) {
      const Quaterniond q = pose.q_WB[b] * disguise.rest[b];
      if (b == 0) {
        translation.push_back(disguise.unit * (disguise.axes * pose.p_WB[0]));
        rotation.push_back(disguise.axes * q);
      } else {
        const int parent = kParents[b];
        translation.push_back(motion.joints[b].offset);
        rotation.push_back((pose.q_WB[parent] * disguise.rest[parent]).conjugate() * q);
      }
    }
  }
  return motion;
}

/// Names of the 22 bodies in the manner of Mixamo.
inline PerBody<std::string> mixamo_names() {
  PerBody<std::string> names = {"Hips",        "LeftUpLeg",    "RightUpLeg", "Spine",        "LeftLeg",
                                "RightLeg",    "Spine1",       "LeftFoot",   "RightFoot",    "Spine2",
                                "LeftToeBase", "RightToeBase", "Neck",       "LeftShoulder", "RightShoulder",
                                "Head",        "LeftArm",      "RightArm",   "LeftForeArm",  "RightForeArm",
                                "LeftHand",    "RightHand"};
  for (std::string& name : names) name = "mixamorig:" + name;
  return names;
}

}  // namespace mimicx::test
