/// Directions of differentiation through one physics step: the articulated-body recursion of
/// physics/aba.h, differentiated.                                          docs/control_derivatives.md §3
///
/// T = double carries one direction, T = Pack one per lane. Names are those of physics/data.h; every one of
/// them means the change of that quantity to first order.
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
  Wrench<T> push;                      ///< external wrench on the root
  std::array<Vec3<T>, kBodies> drive;  ///< joint torque that the targets add

  std::array<Vec3<T>, kBodies> theta;  ///< rotation of the body, R → exp(θ) R
  std::array<Vec3<T>, kBodies> p, w, v;
  std::array<Vec3<T>, kBodies> c_w, c_v;    ///< velocity-product acceleration, at fixed accelerations
  std::array<Wrench<T>, kBodies> rate;      ///< force by velocities, self contact, push
  std::array<Vec3<T>, kBodies> torque;      ///< of a joint
  std::array<Vec3<T>, kBodies> law, range;  ///< its PD law and its range apart, where the law may saturate
  std::array<Vec3<T>, kBodies> held;        ///< PD torque of a saturated joint

  std::array<Wrench<T>, kBodies> force;           ///< bias force of the articulated body
  std::array<Vec3<T>, kBodies> c_w_now, c_v_now;  ///< c of this solve
  std::array<Vec3<T>, kBodies> free;              ///< α of the body were its parent's acceleration unchanged
  std::array<Vec3<T>, kBodies> alpha, a;
  std::array<Vec3<T>, kBodies> qdd;  ///< change of the joint acceleration apart from its turning with θ
};

/// One physics step: `d.state` at its start becomes `d.state` at its end.
template <class T>
void advance_tangent(const SubstepTable<RealOf<T>>& table, TangentData<T>& d);

}  // namespace mimicx::control
