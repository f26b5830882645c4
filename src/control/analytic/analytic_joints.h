/// How joint torques change, and how positions follow velocities.        docs/control_derivatives.md §3
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// Torques of PD and range by rotation, velocity and target of every joint, and, for the joints that are at
/// their bound in some solve of `out`, apart.
template <class Real>
void tabulate_joints(const Model<double>& model, const State<double>& state, const Target<double>& target,
                     const TargetDerivative& turns, const Data<double>& d, SubstepTable<Real>& out);

/// The joints that are at their bound in the solve to come. Those in `kept` keep the torque they have, the
/// others have just been given one along the law at the accelerations in `d`.
template <class Real>
void tabulate_saturated(const Model<double>& model, const Data<double>& d, const PerBody<bool>& kept,
                        List<SaturatedTable<Real>>& out);

/// Rotations after the step. @param state  after the step
template <class Real>
void tabulate_integration(const Model<double>& model, const State<double>& state, SubstepTable<Real>& out);

}  // namespace mimicx::control
