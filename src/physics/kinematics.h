/// Positions, velocities and velocity-product terms, root to tip.             RBDA table 5.1 pass 1, our axes
///
/// With the body's own joint centre as origin and world-parallel axes, X_λ(i) is a translation by r, and
/// using classical accelerations of the joint centre the joint's velocity-product term is
///     c = (ω_λ × ω_J ;  ω_λ × (ω_λ × r)),          derived in docs/physics.md §2, (2).
///
/// The passes are marked `flatten`: every call inside them is inlined. Without it GCC calls the larger
/// operators of spatial.h as functions, through memory, which costs a third of the speed in double.
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

template <class T>
[[gnu::flatten]] void compute_kinematics(const Model<RealOf<T>>& model, const State<T>& state, Data<T>& d) {
  d.q_WB[0] = state.q[0];
  d.R_WB[0] = to_matrix(d.q_WB[0]);
  d.p_WB[0] = state.p_root;
  d.w[0] = d.R_WB[0] * state.omega[0];
  d.v[0] = state.v_root;
  for (int i = 1; i < kBodies; ++i) {
    const int lambda = kParents[i];
    d.q_WB[i] = d.q_WB[lambda] * state.q[i];
    d.R_WB[i] = to_matrix(d.q_WB[i]);
    d.r[i] = d.R_WB[lambda] * spread<T>(model.joint_offset[i]);
    d.p_WB[i] = d.p_WB[lambda] + d.r[i];
    const Vec3<T> w_J = d.R_WB[i] * state.omega[i];
    const Vec3<T> w_x_r = cross(d.w[lambda], d.r[i]);
    d.w[i] = d.w[lambda] + w_J;
    d.v[i] = d.v[lambda] + w_x_r;
    d.c_w[i] = cross(d.w[lambda], w_J);
    d.c_v[i] = cross(d.w[lambda], w_x_r);
  }
}

/// Rigid-body inertia in world axes and the force the body needs for its velocity-product acceleration,
/// minus its weight:  (ω × I_o ω − d × m g ;  m ω × (ω × d) − m g).
/// RBDA eq. 2.72 in the axes of docs/physics.md §2, (1)
template <class T>
[[gnu::flatten]] void compute_rigid_bodies(const Model<RealOf<T>>& model, Data<T>& d) {
  const T g(model.config.gravity);
  for (int i = 0; i < kBodies; ++i) {
    const T m(model.mass[i]);
    const Sym3<RealOf<T>>& I = model.inertia_o[i];
    d.I_o[i] = congruence(d.R_WB[i], Sym3<T>{T(I.xx), T(I.xy), T(I.xz), T(I.yy), T(I.yz), T(I.zz)});
    d.com[i] = d.R_WB[i] * spread<T>(model.com[i]);
    const Vec3<T> h = m * d.com[i];
    const T weight = m * g;
    Vec3<T> f = cross(d.w[i], cross(d.w[i], h));
    f.z += weight;
    Vec3<T> n = cross(d.w[i], d.I_o[i] * d.w[i]);
    n.x = fma(h.y, g, n.x);
    n.y = fma(-h.x, g, n.y);
    d.bias[i] = {n, f};
  }
}

}  // namespace mimicx::physics
