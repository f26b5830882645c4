/// One physics step, and one control interval of them.
///
/// Semi-implicit Euler: velocities with the accelerations of the implicit solve, then positions with the new
/// velocities. Errors are of first order in dt (tests/physics shows the order on a free tumble).
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

/// Accelerations d.qdd, d.a_w, d.a_v under joint torques alone: no floor, no self contact, no PD, no limits,
/// armature included. The pure algorithm, for oracles and audits.
/// @param tau  joint torques in the child's frame, N·m; entry 0 unused; of a hinge only the part along
///             its axis counts
template <class T>
void forward_dynamics(const Model<RealOf<T>>& model, const State<T>& state, const PerBody<Vec3<T>>& tau,
                      Data<T>& d);

/// One physics step towards `target`.
/// @param applied  where not null, what acted is added to it
/// @param help  where not null, an external wrench on the pelvis, about its joint centre in world axes, that
///        no body could exert on itself: for planning with penalised help (src/control). Not in `applied`, so
///        that an audit finds it unexplained.
/// @return mask of the lanes that have gone wrong (`gone_wrong` of integration.h): their state is not to be
///         used; other lanes are untouched by them
template <class T>
MaskOf<T> step(const Model<RealOf<T>>& model, const Target<T>& target, State<T>& state, Data<T>& d,
               Applied<T>* applied = nullptr, const Wrench<T>* help = nullptr);

/// The solve inside `step` without the integration: accelerations and applied forces at `state`.
template <class T>
void solve_accelerations(const Model<RealOf<T>>& model, const Target<T>& target, const State<T>& state,
                         Data<T>& d, const Wrench<T>* help = nullptr);

/// Adds what acted in the last solve to `applied`.
template <class T>
void record_applied(const Model<RealOf<T>>& model, const Data<T>& d, Applied<T>& applied);
template <class T>
void clear(Applied<T>& applied);

/// Bodies' world poses and velocities of a state, in d.q_WB, d.p_WB, d.w, d.v.
template <class T>
void update_kinematics(const Model<RealOf<T>>& model, const State<T>& state, Data<T>& d);

}  // namespace mimicx::physics
