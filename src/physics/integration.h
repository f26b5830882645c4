/// From accelerations to the next state: semi-implicit Euler.                    docs/physics.md §6
///
/// Velocities first, positions with the new velocities, quaternions by the exponential map.
#pragma once

#include "physics/data.h"

namespace mimicx {

template <class T>
[[gnu::flatten]] void integrate(const Model<RealOf<T>>& model, const Data<T>& d, State<T>& s) {
  const T dt(model.dt);
  s.v_root = add_scaled(s.v_root, dt, d.a_v[0]);
  s.p_root = add_scaled(s.p_root, dt, s.v_root);
  for (std::size_t i = 0; i < kBodies; ++i) {
    s.omega[i] = add_scaled(s.omega[i], dt, transpose_times(d.R_WB[i], d.qdd[i]));
    s.q[i] = renormalised(s.q[i] * exp_map(dt * s.omega[i]));
  }
}

}  // namespace mimicx
