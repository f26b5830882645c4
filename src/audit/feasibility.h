/// Inverse dynamics of a clip, frame by frame: residual root wrench and joint torques.
///
/// Newton–Euler over the character's masses and inertias (audit/body_loads.h), with accelerations from second
/// differences of the frames. Where a foot (or, on request, any body) touches the floor, contact forces
/// inside friction cones (μ = 1, four edges) supply as much as they can of the force and moment that the
/// whole body needs (audit/friction_cones.h), moments about the centre of mass. The rest is the root
/// residual: an external wrench that would have to act on the body. Joint torques follow from the motion of
/// the bodies beyond a joint and the contact forces on them. Nothing is smoothed, so this is for exact
/// motions; audit/pose_needs.h judges real ones.
///
/// What it does not do: no armature of the joints, no contacts with anything but the ground; while both feet
/// stand, the load is split so that the forces are smallest, which need not be how a person splits it.
#pragma once

#include <cmath>

#include "motion/clip.h"

namespace mimicx::audit {

/// Demands of one frame.
struct FrameDemand {
  Vector3d residual_force = Vector3d::Zero();   ///< N
  Vector3d residual_moment = Vector3d::Zero();  ///< about the centre of mass, N·m
  PerBody<Vector3d> torque;  ///< of the joint that connects a body to its parent, world axes, N·m
};

/// Which points may touch the floor.
struct Touching {
  double height = 0.004;    ///< a point up to this far above the floor touches it, m
  double depth = HUGE_VAL;  ///< a point up to this far below the floor touches it, m
  bool whole_body = false;  ///< every contact point of the character, not only those of the feet
};

/// Demands of the frames 1 … n − 2 of an exact motion on its own character (`motion::character_of`).
/// @throws std::invalid_argument for fewer than 3 frames
std::vector<FrameDemand> motion_demands(const motion::Clip& clip, const Touching& touching = {});

/// |τ| over the limit of the joint; for a hinge the part about its axis. Entry 0 is 0.
/// @param poses  of the frame
PerBody<double> torque_ratios(const Character& character, const BodyPoses& poses, const FrameDemand& demand);

/// Summary of a clip. Residuals relative to the body's weight: forces in parts of it, moments in metres.
struct Feasibility {
  double mean_force = 0.0, max_force = 0.0;    ///< of the residual, 1 = the weight
  double mean_moment = 0.0, max_moment = 0.0;  ///< of the residual, N·m per N of weight
  double worst_torque = 0.0;                   ///< largest share of a limit, 1 = at the limit
  int worst_joint = 0;                         ///< index of the body
  int frames_over_limit = 0;                   ///< with at least one torque over its limit
};
Feasibility feasibility(const motion::Clip& clip);

}  // namespace mimicx::audit
