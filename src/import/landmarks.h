/// Landmarks of a foreign skeleton: its joints for the 22 bodies, and quantities that do not depend on its
/// unit, axes or rest pose.
#pragma once

#include <vector>

#include "import/retarget/joint_names.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// The joints of one pose, by body. A body without a joint of its own has position and rotation of its
/// parent.
struct Landmarks {
  PerBody<Vector3d> p;
  PerBody<Quaterniond> q;

  Vector3d between(int left, int right) const { return 0.5 * (p[left] + p[right]); }
  /// Unit vector from one joint to another.
  Vector3d direction(int from, int to) const { return (p[to] - p[from]).normalized(); }
  /// Unit vector from the middle of the hips to the middle of the shoulders.
  Vector3d trunk() const;
  /// Unit vector in which the body faces: perpendicular to hips and trunk.
  Vector3d forward() const;
};

Landmarks landmarks_of(const SkeletonPose& pose, const JointMap& map);
/// The landmarks turned, then scaled.
Landmarks transformed(const Landmarks& landmarks, const Quaterniond& turn, double scale);

/// Every frame of a skeleton's motion.
PerFrame<Landmarks> landmarks_of(const SkeletonMotion& motion, const JointMap& map);
/// The joints of a motion on our body.
PerFrame<Landmarks> landmarks_of(const PerFrame<BodyPoses>& poses);

/// Mean length of a leg, hip to knee to ankle, over the poses.
double leg_length(const PerFrame<Landmarks>& poses);

/// How far a pose is from a straight stance, ≥ 0: bends of hips and knees, half the bends of the elbows, and
/// how far the arms reach forward or back.
double bend_of(const Landmarks& pose);
/// Whether a person stands, whichever axis is up: straight legs under the trunk, arms in the plane of the
/// body.
bool is_stance(const Landmarks& pose);
/// Whether a pose is a stance with the arms straight out to the sides.
bool is_t_pose(const Landmarks& pose);

/// Whether the first frame is a T-pose and the second one a jump away from it.
bool starts_with_t_pose(const PerFrame<Landmarks>& frames);

}  // namespace mimicx::import
