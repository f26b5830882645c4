/// The external wrench that a motion needs, frame by frame, by its poses alone: its feasibility.
/// docs/physics.md §9
///
/// Newton–Euler gives the moment and force that the whole body needs to move as its poses do
/// (audit/body_loads.h). Floor forces at the points near the floor, inside friction cones of eight edges,
/// supply as much as they can (audit/friction_cones.h; 1 N·m counts as much as 1 N). The rest would have to
/// act from outside.
///
/// Second differences of real poses are noisy. So a frame's need is a weighted mean of the needs around it.
/// The weights turn second differences into the second derivative of the least-squares parabola over 2m + 1
/// frames (A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964)),
///     w_j ∝ (m² − j²)((m + 1)² − j²),  |j| < m,  m = window · fps, at least 1   (docs/physics.md §9, (13))
/// with half of the amplitude left at 0.45/window Hz. A mean of feasible needs is feasible if every point may
/// push that touched the floor at any of these frames. Each such point pushes from its position, relative to
/// the centre of mass, at the nearest frame at which it touched. So smoothing never makes a feasible motion
/// infeasible; it hides faults that are shorter than the window.
///
/// What it does not do: contacts need not be consistent from frame to frame, points may slide under load,
/// joints have no bounds (their torques are reported), and only the floor and the plates of the scene carry
/// the body.
#pragma once

#include "character/character.h"
#include "core/containers.h"
#include "core/units.h"

namespace mimicx::audit {

struct PoseNeedsConfig {
  double window = 0.1;  ///< half of the time over which the parabola is fitted, s
  double reach = 0.02;  ///< a point up to this far above the floor touches it, m; so does any point below it
  double friction = 1.0;      ///< μ
  double gravity = kGravity;  ///< m/s², downwards
};

/// One frame.
struct PoseNeed {
  Vector3d force = Vector3d::Zero();   ///< external, N
  Vector3d moment = Vector3d::Zero();  ///< external, about the centre of mass, N·m
  double floor = 0.0;                  ///< upward force of the floor, N
  int points = 0;                      ///< contact points that may push
  double lowest = 0.0;                 ///< height of the lowest contact point over the ground, m
  double in_box = 0.0;                 ///< depth of the deepest one in a side of a box (`Scene::way_out`), m
  PerBody<double> torque{};            ///< of each joint in parts of its bound; [0] is 0
};

struct PoseNeeds {
  double mass = 0.0, weight = 0.0;  ///< kg, N
  double fps = 30.0;
  PerFrame<PoseNeed> frames;  ///< the first and the last have the needs of their neighbours
};

/// Moment about the centre of mass and force that the whole body needs from outside beside gravity, floor
/// forces included, smoothed as above, N·m, N. The first and the last have those of their neighbours.
/// @throws std::invalid_argument as `needs_of_poses`
PerFrame<Vector6d> wanted_wrenches(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                                   const PoseNeedsConfig& config = {});

/// @throws std::invalid_argument for fewer than 3 frames, or a setting out of range
PoseNeeds needs_of_poses(const Character& character, const PerFrame<BodyPoses>& poses, double fps,
                         const PoseNeedsConfig& config = {}, const Scene& scene = {});

}  // namespace mimicx::audit
