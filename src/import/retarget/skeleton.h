/// A motion on the skeleton of its file, as in BVH and DeepMimic files.
///
/// Units, axes, number of joints and their names are those of the file. A joint's rotation and translation
/// are relative to its parent; the translation is the rest offset unless the file has position channels. End
/// sites are joints without rotation, named after their parent with "_end".
///
/// What it does not do: no mapping to the human body; retarget.h finds it by names and geometry.
#pragma once

#include <string>
#include <vector>

#include "character/bodies.h"
#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::import {

/// One value per joint of a skeleton, in the order of `SkeletonMotion::joints`.
template <class T>
using PerJoint = PerFrame<T>;

struct SkeletonJoint {
  std::string name;  ///< printable UTF-8
  int parent = -1;   ///< index of a joint before this one; -1 for a root; joint 0 is one
  Vector3d offset;   ///< rest position in the parent's frame, file's unit
  bool end_site = false;
};

struct SkeletonMotion {
  std::string name;  ///< file name without folder and suffix
  std::string path;  ///< of the file, for messages
  double fps = 30.0;
  double largest_angle = 0.0;   ///< magnitude of a rotation channel, as the file has it; 0: no channels
  bool positions_only = false;  ///< made of joint positions, which do not show how far feet roll
  char metric_up = 0;           ///< the format defines metres and, usually y, up; 0: retargeting detects both
  PerJoint<SkeletonJoint> joints;
  PerFrame<PerJoint<Vector3d>> translation;  ///< [frames][joints] in the parent's frame, file's unit
  PerFrame<PerJoint<Quaterniond>> rotation;  ///< [frames][joints] relative to the parent
  std::vector<std::string> warnings;         ///< one line each
  std::vector<std::string> decisions;        ///< what the reader decided, one line each

  int frames() const { return rotation.count(); }
};

/// Largest number of joints times frames of a file: 16 M take 0.9 GB and are two hours of a body at 100
/// frames per second.
inline constexpr std::size_t kMaxJointFrames = std::size_t{1} << 24;

inline constexpr double kMaxFps = 2000.0;
/// Index of the joint of each body, -1 where there is none. Of `map_joints`, hips, knees, ankles, shoulders,
/// elbows, wrists, pelvis and chest (spine3) always have one. The joint of a wrist or foot may be an end
/// site.
using JointMap = PerBody<int>;

/// World poses of all joints, file's unit and axes.
struct SkeletonPose {
  PerJoint<Vector3d> p;
  PerJoint<Quaterniond> q;
};
SkeletonPose pose_of(const SkeletonMotion& motion, int frame);
/// The pose with all rotations the identity and all translations the rest offsets.
SkeletonPose rest_pose(const SkeletonMotion& motion);

}  // namespace mimicx::import
