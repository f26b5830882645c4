/// Turns a plan into a motion: moves the whole body so that its balance is that of the plan.
///
/// Centre of mass c (height h over the ground at p, known from the plan), centre of pressure p, gravity g.
/// The moments about p of gravity, of inertia and of the change of angular momentum L about c vanish:
///     (g + ḧ)(c − p) − h c̈ = ℓ,     ℓ = (L̇_y, −L̇_x)/m
/// (Kajita et al., "Biped walking pattern generation by using preview control of zero-moment point",
/// ICRA 2003, with the terms of ḧ and L̇ kept). On the frames, with second differences for the
/// accelerations, this is one tridiagonal system per axis, with c = p at both ends. ℓ depends on the
/// motion: the system is solved again with the ℓ of the last motion (a fixed point). In flight the equation
/// is c̈ = 0, and a height that is a parabola there gives ballistic flight. In flight L is constant: a smooth
/// tilt of pelvis and trunk compensates the angular momentum of legs and arms, also where the floor carries
/// less than 0.3 of the weight (by the same fixed point). What it does not do: no joint torques or contacts
/// (audit/feasibility.h computes them); it does not move feet.
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
/// @param com  horizontal position of the centre of mass, m
double com_height_for_knee(const Character& character, const PlanFrame& frame, const Eigen::Vector2d& com,
                           double knee);

/// The motion of a plan. Where a step would stretch a leg too far, the centre of mass is lowered.
/// @throws std::invalid_argument when a leg is still too short for its place
PerFrame<SynthPose> solve_plan(const Character& character, PerFrame<PlanFrame> plan, double fps);

}  // namespace mimicx::synth
