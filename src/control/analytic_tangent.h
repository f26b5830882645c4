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
  Vec3<T> p, v;                             ///< root, world
  std::array<Vec3<T>, kBodies> turn, spin;  ///< δ of q·exp(δ), and of omega; body frames
};

/// The changes inside a step.
template <class T>
struct TangentData {
  StateTangent<T> state;
  Wrench<T> push;                      ///< external wrench on the root, world
  std::array<Vec3<T>, kBodies> drive;  ///< joint torque that the targets add

  std::array<Vec3<T>, kBodies> theta, turn;  ///< of the body; of the joint alone, R δ
  std::array<Vec3<T>, kBodies> p, v;         ///< of the joint centre, world, where it is asked for
  std::array<Vec3<T>, kBodies> w;
  std::array<Vec3<T>, kBodies> c_w, c_v;    ///< velocity-product acceleration; of c_v the parent's part
  std::array<Wrench<T>, kBodies> rate;      ///< force by velocities, self contact, push
  std::array<Vec3<T>, kBodies> torque;      ///< of a joint
  std::array<Vec3<T>, kBodies> law, range;  ///< its PD law and its range apart, where the law may saturate
  std::array<Vec3<T>, kBodies> held;        ///< PD torque of a saturated joint

  std::array<Wrench<T>, kBodies> force;           ///< bias force of the articulated body
  std::array<Vec3<T>, kBodies> c_w_now, c_v_now;  ///< acceleration that the parent hands on, were its own 0
  std::array<Vec3<T>, kBodies> free;              ///< α of the body, were the parent's accelerations 0
  std::array<Vec3<T>, kBodies> alpha, a;
  std::array<Vec3<T>, kBodies> qdd;  ///< joint acceleration: R times the change of dω/dt
};

/// One physics step: `d.state` at its start becomes `d.state` at its end.
template <class T>
void advance_tangent(const SubstepTable<RealOf<T>>& table, TangentData<T>& d);

}  // namespace mimicx::control
