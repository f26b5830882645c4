/// Rows of the derivative through one physics step, backwards: the articulated-body recursion of
/// physics/aba.h, differentiated and transposed.                            docs/control_derivatives.md §4
///
/// A row of F is the derivative of one coordinate of the frame's end by all earlier quantities. T = double
/// carries one row, T = Pack one per lane. Names are those of physics/data.h. Each member is the derivative
/// of the row's coordinate by D of that quantity, where D is the change as seen by an observer who turns with
/// the body (docs/control_derivatives.md §2, (2)); p and v are in world coordinates.
#pragma once

#include "control/analytic/analytic_tables.h"

namespace mimicx::control {

/// Derivatives by the state; of hinges the component along the axis.
template <class T>
struct StateAdjoint {
  Vec3<T> p, v;                 ///< root, world
  PerBody<Vec3<T>> turn, spin;  ///< δ of q·exp(δ), and omega; body frames
};

/// Derivatives by all quantities of a step.
template <class T>
struct AdjointData {
  StateAdjoint<T> state;
  Array<T, kDofs> from, to;  ///< residuals of the old and the new target
  Wrench<T> assistance;      ///< on the pelvis

  PerBody<Vec3<T>> theta, p, v;       ///< of the body, world, where `placed`
  PerBody<Vec3<T>> w;                 ///< angular velocity of the body
  PerBody<Vec3<T>> turn;              ///< of the joint, R δ
  PerBody<Vec3<T>> torque;            ///< of the joint
  PerBody<Vec3<T>> law, range, held;  ///< its PD law, its range, the constant in place of the law

  // Transposed solve. Input: derivatives by its joint accelerations (`qdd`), applied like joint torques, and
  // by the accelerations of its bodies (`force`), applied like forces. Output: accelerations (`alpha`, `a`),
  // and the forces that joints transmit. Sums are over the solves of a step. docs/control_derivatives.md §4
  PerBody<Vec3<T>> qdd;
  PerBody<Wrench<T>> force;
  PerBody<Vec3<T>> free;      ///< α of the body for a parent at rest
  PerBody<Vec3<T>> alpha, a;  ///< of a solve other than the last
  PerBody<Vec3<T>> sum_alpha, sum_a, sum_n, sum_f;
};

/// One physics step backwards: d.state goes from the derivative by the state after the step to that by the
/// state before it; the derivatives by residuals and assistive wrench are accumulated.
template <class T>
void step_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d);

}  // namespace mimicx::control
