/// Derivatives of the forces of floor contacts in one solve of a step.   docs/control_derivatives.md §3
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// The velocities at which the contacts were last linearised, m/s; index as in Data::ground.
using ContactVelocities = Array<Vec3<double>, kMaxContacts>;

/// Before the first solve: the velocities at the start of the step.
void velocities_at_start(const Data<double>& d, ContactVelocities& out);
/// Before a later solve: the velocities that the accelerations in `d` predict for the end of the step.
void predicted_velocities(const Model<double>& model, const Data<double>& d, ContactVelocities& out);

/// Accelerations of the bodies.
struct Accelerations {
  PerBody<Vec3<double>> alpha, a;
};

/// One entry per body with a point that pushes.
/// @param d  after the solve
/// @param before  accelerations at which the contacts were linearised; null in the first solve
template <class Real>
void tabulate_floor(const Model<double>& model, const Data<double>& d, const ContactVelocities& linearised,
                    const Accelerations* before, List<FloorTable<Real>>& out);

}  // namespace mimicx::control
