/// What a foreign skeleton shows of a body: the joints that stand for the 22 bodies, and what can be read
/// from them without knowing its unit, axes or rest pose.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "import/retarget/joint_names.h"
#include "import/retarget/skeleton.h"

namespace mimicx::import {

/// The joints of one pose by body. A body without a joint of its own is where, and turns as, its parent.
struct Landmarks {
  PerBody<Vector3d> p;
  PerBody<Quaterniond> q;

  Vector3d between(int left, int right) const { return 0.5 * (p[left] + p[right]); }
  /// Unit vector from one joint to another.
  Vector3d direction(int from, int to) const { return (p[to] - p[from]).normalized(); }
  /// Unit vector from the middle of the hips to the middle of the shoulders.
  Vector3d trunk() const;
  /// Unit vector to where the body faces: across hips and trunk.
  Vector3d forward() const;
};

Landmarks landmarks_of(const SkeletonPose& pose, const JointMap& map);
/// Turned, then scaled.
Landmarks transformed(const Landmarks& landmarks, const Quaterniond& turn, double scale);

/// Mean length of a leg, hip to knee to ankle, over the poses.
double leg_length(const PerFrame<Landmarks>& poses);

/// How far a pose is from a straight stance, 0 … : bends of hips and knees, half those of the elbows, and
/// arms that reach forward or back.
double bend_of(const Landmarks& pose);
/// Legs under the trunk and straight, arms in the plane of the body: a person who stands, whichever axis is
/// up.
bool is_stance(const Landmarks& pose);
/// A stance with the arms straight out to the sides.
bool is_t_pose(const Landmarks& pose);

/// The first frame is a T-pose out of which the motion jumps.
bool starts_with_t_pose(const PerFrame<Landmarks>& frames);

/// The axis along which stretched bodies stand, over all poses whose legs are straight under the trunk; none
/// where there are few of these, or they stand along different axes. 'x', 'y', 'z', or capitals for the
/// negative axes.
std::optional<char> up_of(const PerFrame<Landmarks>& poses);

/// A unit of length that makes a leg of `length` file units a human one (0.45 to 1.2 m).
struct Unit {
  const char* name;
  double metres;
};
/// @return none where no known unit does
std::optional<Unit> unit_of(double length);

}  // namespace mimicx::import
