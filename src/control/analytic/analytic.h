/// Analytic derivatives of a control frame: how the state after it changes with the state before it and with
/// the PD targets.                                                           docs/control_derivatives.md
///
/// The derivative is that of `step` (semi-implicit Euler; implicit PD, ranges and floor contacts with every
/// linearisation; torque bounds; self contact), applied for every physics step of the control interval.
/// Inside a step the recursion of the articulated-body algorithm is differentiated, after J. Carpentier and
/// N. Mansard, "Analytical Derivatives of Rigid Body Dynamics Algorithms" (RSS 2018), and transposed: rows of
/// the derivative are propagated backwards through the frame, for it has fewer rows than columns. All rows
/// share the articulated inertias of the nominal step, so that a row costs two sweeps over the bodies per
/// solve. The rows are the lanes of T: one with double, kLanes with Pack.
///
/// Contacts, saturated joints, exceeded ranges and self contacts are those of the nominal motion. At a switch
/// of one of them the function has a kink, and this is the one-sided derivative; differences.h has a
/// derivative smoothed over a neighbourhood.
#pragma once

#include "control/analytic/analytic_adjoint.h"
#include "control/analytic/analytic_tables.h"
#include "control/tangent.h"

namespace mimicx::control {

/// Columns of a frame's derivative: the state's tangent, the residuals of the old target, those of the new
/// one; then, if requested, the assistive wrench on the pelvis.
inline constexpr int kFrameColumns = kTangent + 2 * kDofs;
inline constexpr int kFrameColumnsWithAssistance = kFrameColumns + 6;

/// One control frame. The PD target moves from one end to the other as in `advance_interval`; at the ends it
/// is the reference turned by residuals: q* = q_reference · exp(residual), a rotation vector per ball joint
/// and an angle per hinge, in the order of `first_dof`. Feed-forward velocities ω* are the reference's.
struct ControlFrame {
  State<double> start;
  Target<double> from, to;                              ///< references at the two ends
  Array<double, kDofs> from_residual{}, to_residual{};  ///< rad
  /// Moment (N·m) and force (N) on the pelvis, about its joint centre in world axes: `assistance` of `step`.
  Wrench<double> assistance = {zero3<double>(), zero3<double>()};
  int substeps = 8;
};

template <class T>
struct FrameDerivative {
  /// d end / d (start, from_residual, to_residual [, assistance: moment, force]), [122][232 or 238].
  Eigen::Matrix<RealOf<T>, kTangent, Eigen::Dynamic, Eigen::RowMajor> F;
  State<double> end;   ///< of the nominal motion
  bool wrong = false;  ///< the nominal motion failed (`step`): F and end must not be used
};

/// Buffers of one worker; large, reuse them from frame to frame. Their contents do not matter.
template <class T>
struct FrameScratch {
  Data<double> data;
  List<SubstepTable<RealOf<T>>> substeps;
  AdjointData<T> adjoint;
};

/// Differentiates one control frame. A row does not depend on the lane it is computed in, nor on its
/// neighbours.
/// @param with_assistance  also by the assistive wrench
/// @throws std::invalid_argument for fewer than one physics step
template <class T>
void differentiate_frame(const Model<double>& model, const ControlFrame& frame, bool with_assistance,
                         FrameScratch<T>& scratch, FrameDerivative<T>& out);

}  // namespace mimicx::control
