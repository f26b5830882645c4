/// The forces that a simulated motion has beside its poses, in terms that others ask for: what the floor does
/// to each foot, as force, centre of pressure and free moment.
///
/// Every recorded number is a mean over the interval that ends at its frame (docs/formats.md), so there is
/// one interval less than there are frames, and the time it is true of is its middle.
///
/// With the centre of pressure on the floor z = 0, force, point and free moment are the whole wrench of the
/// floor: the moment about any point p is (point − p) × force + free_moment · z. A floor that gives way
/// carries a foot a little under its surface; the point is where the line of that force meets the surface.
#pragma once

#include <optional>
#include <string>

#include "files/floor_load.h"
#include "motion/clip.h"

namespace mimicx::files {

struct RecordedForces {
  PerFrame<PerBody<Vector6d>>
      ground;  ///< [frames] (moment about the joint centre, force), world axes, N·m, N
  PerFrame<PerBody<Vector3d>> torque;  ///< [frames] from the joint on the body, its own frame, N·m; 0 unused
};

/// What stands in the members of the file that the clip was read from; none where there are no forces.
/// @throws DataError naming clip and member where only some of it is there, or not of its shape
std::optional<RecordedForces> recorded_forces(const motion::Clip& clip);

struct FloorForce {
  Vector3d force = Vector3d::Zero();  ///< on the body, N
  Vector3d point = Vector3d::Zero();  ///< centre of pressure, z = 0, m; where not loaded, under the carrier
  double free_moment = 0;             ///< about the vertical through the point, N·m
  bool loaded = false;                ///< pressed with at least kLeastLoad
};
using FloorForces = Array<FloorForce, kCarriers>;

/// [frames − 1] of the intervals between frames. Joint centres are taken midway between its two frames.
List<FloorForces> floor_forces(const PerFrame<BodyPoses>& poses, const RecordedForces& forces);

/// Length of an arrow that shows a force.
inline constexpr double kMetresPerNewton = 0.001;

/// The middle of interval i (between frames i and i + 1), s.
inline double middle_of_interval(int i, double fps) { return (i + 0.5) / fps; }

}  // namespace mimicx::files
