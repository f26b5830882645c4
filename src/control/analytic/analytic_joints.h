/// Derivatives of joint torques and of the integration of rotations.     docs/control_derivatives.md §3
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// Derivatives of the torques of PD and range by rotation, velocity and target of every joint; of joints that
/// are at their bound in some solve of `out`, PD and range apart.
template <class Real>
void tabulate_joints(const Model<double>& model, const State<double>& state, const StepTarget& target,
                     const Data<double>& d, SubstepTable<Real>& out);

/// The joints that are at their bound in the next solve. Those in `kept` keep their torque, the others have
/// a new torque along the law at the accelerations in `d`.
template <class Real>
void tabulate_saturated(const Model<double>& model, const Data<double>& d, const PerBody<bool>& kept,
                        List<SaturatedTable<Real>>& out);

/// Derivatives of the rotations after the step. @param state  after the step
template <class Real>
void tabulate_integration(const Model<double>& model, const State<double>& state, SubstepTable<Real>& out);

}  // namespace mimicx::control
