/// From accelerations to the next state: semi-implicit Euler.                    docs/physics.md §6
///
/// Velocities first, positions with the new velocities, quaternions by the exponential map.
#pragma once

#include <algorithm>
#include <numbers>

#include "physics/data.h"

namespace mimicx::physics {

template <class T>
[[gnu::flatten]] void integrate(const Model<RealOf<T>>& model, const Data<T>& d, State<T>& s) {
  const T dt(model.dt);
  s.v_root = add_scaled(s.v_root, dt, d.a_v[0]);
  s.p_root = add_scaled(s.p_root, dt, s.v_root);
  for (int i = 0; i < kBodies; ++i) {
    s.omega[i] = add_scaled(s.omega[i], dt, transpose_times(d.R_WB[i], d.qdd[i]));
    s.q[i] = renormalised(s.q[i] * exp_map(dt * s.omega[i]));
  }
}

/// Mask of lanes whose state is not finite or has run away: the pelvis is faster than `max_speed` or more
/// than 100 km from the origin, or a joint turns faster than `max_joint_speed` or by half a turn within a
/// step, the limit of `exp_map`. Comparisons with NaN are false, hence the negation.
template <class T>
MaskOf<T> gone_wrong(const Model<RealOf<T>>& model, const State<T>& s) {
  const T limit(model.config.max_speed * model.config.max_speed);
  const double fastest = std::min(model.config.max_joint_speed, std::numbers::pi * model.config.rate);
  const T spin(fastest * fastest);
  const MaskOf<T> slow = dot(s.v_root, s.v_root) <= limit, near = dot(s.p_root, s.p_root) <= T(1e10);
  MaskOf<T> fine = slow & near;
  for (int i = 0; i < kBodies; ++i) {
    const MaskOf<T> turns_slowly = dot(s.omega[i], s.omega[i]) <= spin;
    fine = fine & turns_slowly;
  }
  return !fine;
}

}  // namespace mimicx::physics
