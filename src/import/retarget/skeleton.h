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
  std::string path;  ///< of the file, for messages
  double fps = 30.0;
  bool metric_y_up = false;  ///< the format defines metres and y up; else retargeting detects both
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
/// The rate rounded to a whole number of frames per second where that differs by less than 0.05 %, else the
/// rate: files print frame times with few digits, 0.0083333 for 120. (29.97 and 30 differ by 0.1 %.)
double whole_rate(double fps);

/// World poses of all joints, file's unit and axes.
struct SkeletonPose {
  PerJoint<Vector3d> p;
  PerJoint<Quaterniond> q;
};
SkeletonPose pose_of(const SkeletonMotion& motion, int frame);
/// The pose with all rotations the identity and all translations the rest offsets.
SkeletonPose rest_pose(const SkeletonMotion& motion);

}  // namespace mimicx::import
