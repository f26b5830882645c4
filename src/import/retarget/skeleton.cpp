#include "import/retarget/skeleton.h"

namespace mimicx::import {

SkeletonPose pose_of(const SkeletonMotion& motion, int frame) {
  const auto& translation = motion.translation[frame];
  const auto& rotation = motion.rotation[frame];
  SkeletonPose pose{translation, rotation};
  for (int j = 0; j < motion.joints.count(); ++j) {
    const int parent = motion.joints[j].parent;
    if (parent < 0) continue;
    pose.q[j] = (pose.q[parent] * rotation[j]).normalized();
    pose.p[j] = pose.p[parent] + pose.q[parent] * translation[j];
  }
  return pose;
}

SkeletonPose rest_pose(const SkeletonMotion& motion) {
  SkeletonPose pose;
  for (const SkeletonJoint& joint : motion.joints) {
    pose.p.push_back(joint.parent < 0 ? joint.offset : pose.p[joint.parent] + joint.offset);
    pose.q.push_back(Quaterniond::Identity());
  }
  return pose;
}

}  // namespace mimicx::import
