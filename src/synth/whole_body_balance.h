/// From a plan to a motion: the whole body moved so that its balance is that of the plan.
///
/// Centre of mass c (height h, known from the plan), centre of pressure p, gravity g. The moments about p
/// of gravity, of inertia and of the change of angular momentum L about c vanish:
///     (g + ḧ)(c − p) − h c̈ = ℓ,     ℓ = (L̇_y, −L̇_x)/m
/// (Kajita et al., "Biped walking pattern generation by using preview control of zero-moment point",
/// ICRA 2003, with the terms of ḧ and L̇ kept). On the frames, with second differences for the
/// accelerations, this is one tridiagonal system per axis, with c = p at both ends. ℓ depends on the
/// motion: the system is solved again with the ℓ of the last motion (a fixed point). In flight the equation
/// is c̈ = 0, and a track of height that is a parabola there gives ballistic flight. Nothing turns a body in
/// flight, L is constant: pelvis and trunk are tilted by a smooth track that takes up what legs and arms do
/// there, and where the floor carries under 0.3 of the weight (the same fixed point).
/// What it does not do: ask for joint torques or contacts (audit/feasibility.h does); move the feet.
#pragma once

#include "core/units.h"
#include "synth/plan_frame.h"

namespace mimicx::synth {

/// Pose in the plan frame, in the simulator's coordinates.
struct SynthPose {
  Vector3d p_root = Vector3d::Zero();
  PerBody<Quaterniond> q;
  Vector3d p_com = Vector3d::Zero();  ///< centre of mass
  double shortfall = 0.0;             ///< of the worse leg, m
  PerSide<double> knee{};             ///< flexion, rad
};

/// Rotations of all joints but those of the legs, which are straight; entry 0 is the root's.
PerBody<Quaterniond> posture_rotations(const PlanFrame& frame);

/// The pose of a frame whose centre of mass is at `p_com`.
SynthPose pose_at(const Character& character, const PlanFrame& frame, const Vector3d& p_com);

/// Height of the centre of mass at which the straighter knee of a pose is flexed by `knee`, rad.
/// @param com  where the centre of mass is, seen from above
double com_height_for_knee(const Character& character, const PlanFrame& frame, const Eigen::Vector2d& com,
                           double knee);

/// Motion of the plan. Where a step stretches a leg too far, the centre of mass goes lower than planned.
/// @throws std::invalid_argument when a leg is too short for its place all the same
PerFrame<SynthPose> solve_plan(const Character& character, PerFrame<PlanFrame> plan, double fps);

}  // namespace mimicx::synth
