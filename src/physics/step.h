/// One physics step.
///
/// Semi-implicit Euler: velocities with the accelerations of the implicit solve, then positions with the new
/// velocities. Errors are of first order in dt (tests/physics shows the order on a free tumble).
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

/// Accelerations d.qdd, d.a_w, d.a_v under joint torques alone: no floor, no self contact, no PD, no limits,
/// armature included. For oracles and audits.
/// @param tau  joint torques in the child's frame, N·m; entry 0 unused; of a hinge only the component along
///             its axis is used
template <class T>
void forward_dynamics(const Model<RealOf<T>>& model, const State<T>& state, const PerBody<Vec3<T>>& tau,
                      Data<T>& d);

/// One physics step towards `target`.
/// @param applied  if not null, the torques and forces that acted are added to it
/// @param assistance  if not null, an assistive wrench on the pelvis, about its joint centre in world axes,
///        which no body can exert on itself: for planning with penalised assistive forces (src/control). It
///        is not in `applied`, so that an audit finds it unexplained.
/// @return mask of the failed lanes (`gone_wrong` of integration.h): their state must not be used; other
///         lanes are not affected
template <class T>
MaskOf<T> step(const Model<RealOf<T>>& model, const Target<T>& target, State<T>& state, Data<T>& d,
               Applied<T>* applied = nullptr, const Wrench<T>* assistance = nullptr);

/// `step` without the integration: accelerations and applied forces at `state`.
template <class T>
void solve_accelerations(const Model<RealOf<T>>& model, const Target<T>& target, const State<T>& state,
                         Data<T>& d, const Wrench<T>* assistance = nullptr);

/// Adds the torques and forces of the last solve to `applied`.
template <class T>
void record_applied(const Model<RealOf<T>>& model, const Data<T>& d, Applied<T>& applied);
template <class T>
void clear(Applied<T>& applied);

/// World poses and velocities of the bodies in a state: fills d.q_WB, d.p_WB, d.w, d.v.
template <class T>
void update_kinematics(const Model<RealOf<T>>& model, const State<T>& state, Data<T>& d);

}  // namespace mimicx::physics
