/// Detects free falls of a body of unknown scale, axes and frame rate. Lengths are in leg lengths, times in
/// frames.
#pragma once

#include <utility>
#include <vector>

#include "import/landmarks.h"

namespace mimicx::import {

/// The joints of a motion in lengths of the leg.
struct RoughBody {
  PerFrame<PerBody<Vector3d>> p;
  PerFrame<Vector3d> center;  ///< roughly the centre of mass
  double speed = 0.0;         ///< median speed of the joints, a frame
};
RoughBody rough_body_of(const PerFrame<Landmarks>& poses);

/// How far the surface reaches beyond a joint, in lengths of the leg.
double radius_of(int body);

/// The body whose surface is lowest along `up`, and the height of its lowest point.
std::pair<int, double> lowest_of(const PerBody<Vector3d>& p, const Vector3d& up);

/// Accelerations along −`up`, in lengths of the leg a frame², of the intervals in which nothing is low and
/// the centre of mass bends in this direction alone. @param lowest  height of the lowest point of every frame
std::vector<double> falls_along(const RoughBody& body, const std::vector<double>& lowest, const Vector3d& up);
/// The same, from the poses.
std::vector<double> falls_along(const PerFrame<Landmarks>& poses, const Vector3d& up);

}  // namespace mimicx::import
