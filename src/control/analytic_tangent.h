/// Directions of differentiation through one physics step: the articulated-body recursion of
/// physics/aba.h, differentiated.                                          docs/control_derivatives.md §3
///
/// T = double carries one direction, T = Pack one per lane. Names are those of physics/data.h; every one
/// means the change of that quantity to first order, as an observer sees it who turns with the body:
///     D x = dx − θ × x,      θ the body's own change of rotation, R → exp(θ) R.
/// What is fixed to the body has D = 0, above all its inertia.
#pragma once

#include "control/analytic_tables.h"

namespace mimicx::control {

/// Change of a state; of hinges the part along the axis.
template <class T>
struct StateTangent {
  Vec3<T> p, v;                 ///< root, world
  PerBody<Vec3<T>> turn, spin;  ///< δ of q·exp(δ), and of omega; body frames
};

/// The changes inside a step.
template <class T>
struct TangentData {
  StateTangent<T> state;
  Wrench<T> help;          ///< on the pelvis, world
  PerBody<Vec3<T>> drive;  ///< joint torque that the targets add

  PerBody<Vec3<T>> theta, turn;  ///< of the body; of the joint alone, R δ
  PerBody<Vec3<T>> p, v;         ///< of the joint centre, world, where it is asked for
  PerBody<Vec3<T>> w;
  PerBody<Vec3<T>> c_w, c_v;    ///< velocity-product acceleration; of c_v the parent's part
  PerBody<Wrench<T>> rate;      ///< force by velocities, self contact, help
  PerBody<Vec3<T>> torque;      ///< of a joint
  PerBody<Vec3<T>> law, range;  ///< its PD law and its range apart, where the law may saturate
  PerBody<Vec3<T>> held;        ///< PD torque of a saturated joint

  PerBody<Wrench<T>> force;           ///< bias force of the articulated body
  PerBody<Vec3<T>> c_w_now, c_v_now;  ///< acceleration that the parent hands on, were its own 0
  PerBody<Vec3<T>> free;              ///< α of the body, were the parent's accelerations 0
  PerBody<Vec3<T>> alpha, a;
  PerBody<Vec3<T>> qdd;  ///< joint acceleration: R times the change of dω/dt
};

/// One physics step: `d.state` at its start becomes `d.state` at its end.
template <class T>
void advance_tangent(const SubstepTable<RealOf<T>>& table, TangentData<T>& d);

}  // namespace mimicx::control
