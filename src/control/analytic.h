/// Analytic derivatives of a control frame: how the state after it changes with the state before it and with
/// the PD targets.                                                           docs/control_derivatives.md
///
/// What is differentiated is `step` as it is (semi-implicit Euler; implicit PD, ranges and floor contacts
/// with every linearisation; torque bounds; self contact), `substeps` times, the target moving as in a
/// control interval. Inside a step the recursion of the articulated-body algorithm is differentiated, after
/// J. Carpentier and N. Mansard, "Analytical Derivatives of Rigid Body Dynamics Algorithms" (RSS 2018): the
/// articulated inertias of the nominal step are reused, so that a direction costs one sweep over the bodies
/// per solve. The directions are the lanes of T: one with double, kLanes with Pack.
///
/// Who pushes, what is saturated, out of range or in self contact is that of the nominal step. Where one of
/// these is about to change the function has a kink, and this is the derivative of one side. Contact with the
/// floor is stiff: for plans that shall survive a change of contact see the smoothed derivatives.
///
/// State tangent, 122 rows or columns: 0..2 root position, world, m; 3..5 root rotation, q·exp(δ), body
/// frame, rad; 6..60 joint rotations, q·exp(δ), in the order of `first_dof`, one number along the axis for a
/// hinge and three for a ball joint; 61..63 root velocity, world, m/s; 64..66 root angular velocity, body
/// frame, rad/s; 67..121 joint velocities, child's frame.
#pragma once

#include "control/analytic_tables.h"
#include "control/analytic_tangent.h"
#include "physics/step.h"

namespace mimicx::control {

inline constexpr int kFrameStates = 2 * (6 + kDofs);             ///< 122 rows; the first columns
inline constexpr int kFrameColumns = kFrameStates + 2 * kDofs;   ///< + old and new residuals: 232
inline constexpr int kFrameColumnsWithPush = kFrameColumns + 6;  ///< + wrench on the root: 238

/// One control frame. The PD targets are those of a residual action: q* = q_reference · exp(residual), a
/// rotation vector per ball joint and an angle per hinge, in the order of `first_dof`; feed-forward
/// velocities ω* are the reference's.
struct ControlFrame {
  State<double> start;
  Target<double> from, to;                                   ///< references at the frame's two ends
  std::array<double, kDofs> from_residual{}, to_residual{};  ///< rad
  /// Moment (N·m, about the pelvis joint) and force (N), world axes, on the root during the whole frame. No
  /// body has such a hand; penalised, it makes motions followable that no body can follow exactly.
  Wrench<double> push = {zero3<double>(), zero3<double>()};
  int substeps = 8;
};

template <class T>
struct FrameDerivative {
  /// d end / d (start, from_residual, to_residual [, push: moment, force]), [122][232 or 238].
  Eigen::Matrix<RealOf<T>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> F;
  State<double> end;   ///< of the nominal motion
  bool wrong = false;  ///< the nominal motion ran away (`step`): F and end are not to be used
};

/// What one worker needs to differentiate frames; large, to be kept.
template <class T>
struct FrameScratch {
  Data<double> data;
  std::vector<SubstepTable<RealOf<T>>> substeps;
  TangentData<T> tangent;
};

/// Differentiates one control frame. The result depends on the arguments alone; a column's value does not
/// depend on its lane.
/// @param with_push  also by the wrench on the root
/// @throws std::invalid_argument for fewer than one substep
template <class T>
void differentiate_frame(const Model<double>& model, const ControlFrame& frame, bool with_push,
                         FrameScratch<T>& scratch, FrameDerivative<T>& out);

/// The frame itself, without derivatives, by `step` where there is no push.
/// @return the state at its end; `wrong` where not null: whether it ran away
State<double> roll_out_frame(const Model<double>& model, const ControlFrame& frame, Data<double>& data,
                             bool* wrong = nullptr);

}  // namespace mimicx::control
