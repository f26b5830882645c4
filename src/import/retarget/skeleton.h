/// A motion on a skeleton of its own, as BVH and DeepMimic files hold it.
///
/// Everything is in the file's units and axes, and joints are as many, and called what, the file has them. A
/// joint's rotation and translation are relative to its parent; the translation stands at the rest offset
/// unless the file moves it. End sites are joints that never turn, named after their parent with "_end".
///
/// What it does not do: nothing is known here of the human body; retarget.h finds it in the names and the
/// geometry.
#pragma once

#include <string>
#include <vector>

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::import {

/// One value per joint of a skeleton, in the order of `SkeletonMotion::joints`.
template <class T>
using PerJoint = PerFrame<T>;

struct SkeletonJoint {
  std::string name;  ///< printable UTF-8
  int parent = -1;   ///< index of a joint before this one; -1 for the root, which is joint 0
  Vector3d offset;   ///< rest position in the parent's frame, file's unit
  bool end_site = false;
};

struct SkeletonMotion {
  std::string name;  ///< file name without folder and suffix
  std::string path;  ///< where it came from, for messages
  double fps = 30.0;
  bool metric_y_up = false;  ///< the format itself says metres and y up; else retargeting finds both
  PerJoint<SkeletonJoint> joints;
  PerFrame<PerJoint<Vector3d>> translation;  ///< [frames][joints] in the parent's frame, file's unit
  PerFrame<PerJoint<Quaterniond>> rotation;  ///< [frames][joints] relative to the parent
  std::vector<std::string> warnings;         ///< one line each
  std::vector<std::string> decisions;        ///< what reading decided, one line each

  int frames() const { return rotation.count(); }
};

/// Joints times frames that a file may have: 16 M, 0.9 GB of memory; two hours of a body at 100 frames per
/// second.
inline constexpr std::size_t kMaxJointFrames = std::size_t{1} << 24;

inline constexpr double kMaxFps = 2000.0;
/// The whole number of frames per second that a rate stands for, where one is within 0.05 %, else the rate:
/// files print frame times with few digits, 0.0083333 for 120. (29.97 and 30 are 0.1 % apart.)
double whole_rate(double fps);

/// World poses of all joints, file's unit and axes.
struct SkeletonPose {
  PerJoint<Vector3d> p;
  PerJoint<Quaterniond> q;
};
SkeletonPose pose_of(const SkeletonMotion& motion, int frame);
/// Every rotation the identity, every translation the offset.
SkeletonPose rest_pose(const SkeletonMotion& motion);

}  // namespace mimicx::import
