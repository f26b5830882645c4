#include "control/analytic/analytic_adjoint.h"

namespace mimicx::control {
namespace {

// A number of the tables in all lanes.
template <class T>
Vec3<T> wide(const Vec3<RealOf<T>>& a) {
  return {T(a.x), T(a.y), T(a.z)};
}
template <class T>
Mat3<T> wide(const Mat3<RealOf<T>>& m) {
  return {{wide<T>(m.c[0]), wide<T>(m.c[1]), wide<T>(m.c[2])}};
}
template <class T>
Sym3<T> wide(const Sym3<RealOf<T>>& s) {
  return {T(s.xx), T(s.xy), T(s.xz), T(s.yy), T(s.yz), T(s.zz)};
}

// Products that are added to something: a third fewer operations than product and sum.
/// c + a × b
template <class T>
Vec3<T> add_cross(const Vec3<T>& c, const Vec3<T>& a, const Vec3<T>& b) {
  return {fma(a.y, b.z, fma(-a.z, b.y, c.x)), fma(a.z, b.x, fma(-a.x, b.z, c.y)),
          fma(a.x, b.y, fma(-a.y, b.x, c.z))};
}
/// c + m v
template <class T>
Vec3<T> add_times(const Vec3<T>& c, const Mat3<T>& m, const Vec3<T>& v) {
  return add_scaled(add_scaled(add_scaled(c, v.x, m.c[0]), v.y, m.c[1]), v.z, m.c[2]);
}
template <class T>
Vec3<T> add_times(const Vec3<T>& c, const Sym3<T>& s, const Vec3<T>& v) {
  return {fma(s.xx, v.x, fma(s.xy, v.y, fma(s.xz, v.z, c.x))),
          fma(s.xy, v.x, fma(s.yy, v.y, fma(s.yz, v.z, c.y))),
          fma(s.xz, v.x, fma(s.yz, v.y, fma(s.zz, v.z, c.z)))};
}
/// c + mᵀ v
template <class T>
Vec3<T> add_transpose_times(const Vec3<T>& c, const Mat3<T>& m, const Vec3<T>& v) {
  const auto add = [&](T sum, const Vec3<T>& a) { return fma(a.x, v.x, fma(a.y, v.y, fma(a.z, v.z, sum))); };
  return {add(c.x, m.c[0]), add(c.y, m.c[1]), add(c.z, m.c[2])};
}

/// The end of the step: q' = q exp(dt ω'), ω' = ω + dt dω/dt, and the root. docs/control_derivatives.md §3,
/// (8)
template <class T>
[[gnu::flatten]] void integration_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  const T dt(table.dt);
  StateAdjoint<T>& x = d.state;
  const SolveTable<RealOf<T>>& last = table.solve(table.solve_count - 1);
  const Vec3<T> zero = zero3<T>();
  for (int i = 0; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Vec3<T> spin = add_transpose_times(x.spin[i], wide<T>(b.turn_by_omega), x.turn[i]);
    d.qdd[i] = dt * (wide<T>(b.R) * spin);
    x.spin[i] = spin;
    x.turn[i] = transpose_times(wide<T>(b.turn), x.turn[i]);
    d.w[i] = d.force[i].n = d.force[i].f = zero;
    if (b.placed) d.theta[i] = d.p[i] = d.v[i] = zero;
  }
  x.v = add_scaled(x.v, dt, x.p);
  const Vec3<T> by_a = dt * x.v;  // the world's change of a is Da + θ × a
  d.force[0].f = -by_a;
  d.theta[0] = cross(wide<T>(last.body[0].a), by_a);
}

/// Tip to root: the acceleration of each joint for a parent at rest, and the remaining forces, passed to the
/// parent. Skips bodies without a force or torque in their branch.
template <class T>
[[gnu::flatten]] void bias_pass(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& solve,
                                AdjointData<T>& d) {
  for (int i = kBodies - 1; i > 0; --i) {
    if (!solve.wanted[i]) {
      d.free[i] = zero3<T>();
      continue;
    }
    const int lambda = kParents[i];
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const Vec3<T> own_n = d.force[i].n, own_f = d.force[i].f, t = d.qdd[i];
    Vec3<T> n, f;
    if (is_hinge(i)) {
      const Vec3<T> axis = wide<T>(table.body[i].axis);
      const T y = T(s.D_inv.xx) * dot(axis, t - own_n);
      d.free[i] = y * axis;
      n = add_scaled(own_n, y, wide<T>(s.U_n));
      f = add_scaled(own_f, y, wide<T>(s.U_f));
    } else {
      const Vec3<T> z = wide<T>(s.D_inv) * (t - own_n);
      d.free[i] = z;
      n = add_scaled(t, T(-s.delta), z);
      f = add_transpose_times(own_f, wide<T>(s.B), z);
    }
    d.force[lambda].f += f;
    d.force[lambda].n = add_cross(d.force[lambda].n + n, wide<T>(table.body[i].r), f);
  }
  d.force[0].n -= d.qdd[0];
}

/// Adds the result of a solve to that of later solves; kAdd = false, for the last solve, overwrites.
template <bool kAdd, class T>
void collect(const Vec3<T>& value, Vec3<T>& sum) {
  if constexpr (kAdd)
    sum += value;
  else
    sum = value;
}

/// Root to tip: accelerations and transmitted forces, and from them the derivatives by joint torques and by
/// the turns of joints. docs/control_derivatives.md §4, (9) and (10)
template <bool kAdd, class T>
[[gnu::flatten]] void acceleration_pass(const SubstepTable<RealOf<T>>& table,
                                        const SolveTable<RealOf<T>>& solve, PerBody<Vec3<T>>& alphas,
                                        PerBody<Vec3<T>>& as, AdjointData<T>& d) {
  const Mat3<T> M = wide<T>(solve.root_M);
  const Vec3<T> right = add_transpose_times(-d.force[0].n, M, d.force[0].f);
  alphas[0] = wide<T>(solve.root_A_inv) * right;
  as[0] = -add_times(wide<T>(solve.root_C_inv) * d.force[0].f, M, alphas[0]);
  for (int i = 1; i < kBodies; ++i) {
    const int lambda = kParents[i];
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const Vec3<T> alpha_lambda = alphas[lambda];
    const Vec3<T> a = add_cross(as[lambda], alpha_lambda, wide<T>(table.body[i].r));
    const Mat3<T> B = wide<T>(s.B);
    Vec3<T> alpha, n, qdd;
    if (is_hinge(i)) {
      const T y = T(s.D_inv.xx) * (dot(wide<T>(s.U_n), alpha_lambda) + dot(wide<T>(s.U_f), a));
      qdd = add_scaled(d.free[i], -y, wide<T>(table.body[i].axis));
      alpha = alpha_lambda + qdd;
      n = add_times(add_times(d.force[i].n, wide<T>(s.A), alpha), B, a);
    } else {
      const T delta(s.delta);
      const Vec3<T> right_i = add_scaled(B * a, -delta, alpha_lambda);
      alpha = d.free[i] - wide<T>(s.D_inv) * right_i;
      qdd = alpha - alpha_lambda;
      n = add_scaled(d.qdd[i], -delta, qdd);
    }
    const Vec3<T> f = add_times(add_transpose_times(d.force[i].f, B, alpha), wide<T>(s.C), a);
    alphas[i] = alpha;
    as[i] = a;
    collect<kAdd>(n, d.sum_n[i]);
    collect<kAdd>(f, d.sum_f[i]);
    collect<kAdd>(qdd, d.torque[i]);
    Vec3<T> turn = cross(wide<T>(solve.body[lambda].alpha), n);
    turn = add_cross(turn, wide<T>(s.a), f);
    turn = add_cross(turn, alpha_lambda, wide<T>(s.n));
    turn = add_cross(turn, a, wide<T>(s.f));
    collect<kAdd>(turn, d.turn[i]);
  }
  if constexpr (kAdd)
    for (int i = 0; i < kBodies; ++i) {
      d.sum_alpha[i] += alphas[i];
      d.sum_a[i] += as[i];
    }
}

/// Joints that are at their bound in some solve: their torque is the range's plus either the law or a
/// constant in its place. The constant depends on the law and on the acceleration of the solve before it was
/// set, whose derivative is accumulated for that solve.
/// @param alphas  result of the transposed solve; null if it was not needed
template <class T>
void bounds_adjoint(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& solve,
                    const PerBody<Vec3<T>>* alphas, AdjointData<T>& d) {
  for (const LawTable<RealOf<T>>& law : table.law) {
    const int i = law.body;
    const Vec3<T> torque = alphas == nullptr ? zero3<T>() : (*alphas)[i] - (*alphas)[kParents[i]];
    d.range[i] += torque;
    const SaturatedTable<RealOf<T>>* bound = nullptr;
    for (const SaturatedTable<RealOf<T>>& joint : solve.saturated)
      if (joint.body == i) bound = &joint;
    if (bound == nullptr) {
      d.law[i] += torque;
      continue;
    }
    d.held[i] += torque;
    if (!bound->set) continue;
    const Vec3<T> by_law = wide<T>(bound->projection) * d.held[i];
    d.law[i] += by_law;
    d.qdd[i] = T(-law.delta) * by_law;
    d.held[i] = zero3<T>();
  }
}

/// Floor contacts of one body: derivatives by its place and velocity, and by its acceleration in the previous
/// solve, accumulated for that solve.
template <class T>
[[gnu::flatten]] void floor_adjoint(const FloorTable<RealOf<T>>& floor, const Vec3<T>& alpha,
                                    const Vec3<T>& a, AdjointData<T>& d) {
  constexpr int kInputs = FloorTable<RealOf<T>>::kInputs;
  const int i = floor.body;
  const T answer[6] = {alpha.x, alpha.y, alpha.z, a.x, a.y, a.z};
  T by[kInputs];
  for (int k = 0; k < kInputs; ++k) {
    by[k] = T(floor.wrench[0][k]) * answer[0];
    for (int row = 1; row < 6; ++row) by[k] = fma(T(floor.wrench[row][k]), answer[row], by[k]);
  }
  d.theta[i] += Vec3<T>{by[0], by[1], by[2]};
  d.w[i] += Vec3<T>{by[3], by[4], by[5]};
  d.v[i] += Vec3<T>{by[6], by[7], by[8]};
  d.p[i].z += by[9];
  d.force[i].n = {-by[10], -by[11], -by[12]};
  d.force[i].f = {-by[13], -by[14], -by[15]};
}

/// The solves, last to first.
template <class T>
void solves_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  const Vec3<T> zero = zero3<T>();
  for (const LawTable<RealOf<T>>& law : table.law)
    d.law[law.body] = d.range[law.body] = d.held[law.body] = zero;
  const int last = table.solve_count - 1;
  for (int k = last; k >= 0; --k) {
    const SolveTable<RealOf<T>>& solve = table.solve(k);
    PerBody<Vec3<T>>&alphas = k == last ? d.sum_alpha : d.alpha, &as = k == last ? d.sum_a : d.a;
    const bool needed = solve.wanted[0];
    if (needed) {
      bias_pass(table, solve, d);
      if (k == last)
        acceleration_pass<false>(table, solve, alphas, as, d);
      else
        acceleration_pass<true>(table, solve, alphas, as, d);
    }
    if (k > 0)
      for (int i = 0; i < kBodies; ++i) d.qdd[i] = d.force[i].n = d.force[i].f = zero;
    bounds_adjoint(table, solve, needed ? &alphas : nullptr, d);
    if (!needed) continue;
    for (const FloorTable<RealOf<T>>& floor : solve.floor)
      floor_adjoint(floor, alphas[floor.body], as[floor.body], d);
  }
}

/// Self contact: derivatives by places and velocities of two bodies from those by their forces.
template <class T>
[[gnu::flatten]] void self_contact_adjoint(const SelfPairTable<RealOf<T>>& pair, AdjointData<T>& d) {
  const int body[2] = {pair.i, pair.j};
  for (int side = 0; side < 2; ++side) {
    const int to = body[side];
    T by[12];
    for (T& x : by) x = T(0.0);
    for (int other = 0; other < 2; ++other) {
      const Vec3<T>&n = d.sum_alpha[body[other]], &f = d.sum_a[body[other]];
      const T answer[6] = {n.x, n.y, n.z, f.x, f.y, f.z};
      for (int row = 0; row < 6; ++row)
        for (int k = 0; k < 12; ++k)
          by[k] = fma(T(pair.wrench[6 * other + row][12 * side + k]), answer[row], by[k]);
    }
    d.theta[to] += Vec3<T>{by[0], by[1], by[2]};
    d.w[to] += Vec3<T>{by[3], by[4], by[5]};
    d.v[to] += Vec3<T>{by[6], by[7], by[8]};
    d.p[to] += Vec3<T>{by[9], by[10], by[11]};
  }
}

/// Positions, velocities, velocity products and joint torques, tip to root: docs/control_derivatives.md §3,
/// (4), transposed.
template <class T>
[[gnu::flatten]] void kinematics_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  for (int i = kBodies - 1; i >= 0; --i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Mat3<T> R = wide<T>(b.R);
    const Vec3<T> w = add_transpose_times(add_transpose_times(d.w[i], wide<T>(b.rate_n), d.sum_alpha[i]),
                                          wide<T>(b.rate_f), d.sum_a[i]);
    if (i == 0) {
      d.state.spin[0] = add_transpose_times(d.state.spin[0], R, w);
      break;
    }
    const int lambda = kParents[i];
    const Vec3<T> w_lambda = wide<T>(table.body[lambda].w), n = d.sum_n[i], torque = d.torque[i];
    const Vec3<T> spin = add_scaled(add_cross(w, w_lambda, n), T(-b.damping), torque);
    const Vec3<T> u = add_cross(w, n, wide<T>(b.w_joint));  // the parent's ω as the child sees it
    Vec3<T> turn = add_cross(d.turn[i], u, w_lambda);
    Vec3<T> by_w_lambda = add_transpose_times(d.w[lambda] + u, wide<T>(b.centripetal), d.sum_f[i]);
    if (b.placed) {
      const Vec3<T> r = wide<T>(b.r), theta = d.theta[i], p = d.p[i], v = d.v[i];
      turn += theta;
      by_w_lambda = add_cross(by_w_lambda, r, v);
      d.p[lambda] += p;
      d.v[lambda] += v;
      d.theta[lambda] = add_cross(add_cross(d.theta[lambda] + theta, r, p), wide<T>(b.w_x_r), v);
    }
    d.w[lambda] = by_w_lambda;
    d.state.spin[i] = add_transpose_times(d.state.spin[i], R, spin);
    d.state.turn[i] =
        add_transpose_times(add_transpose_times(d.state.turn[i], R, turn), wide<T>(b.stiffness), torque);
  }
}

/// The root's place, and the assistive wrench, which does not turn with the root.
template <class T>
void root_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  const BodyTable<RealOf<T>>& root = table.body[0];
  const Vec3<T> n = d.sum_alpha[0], f = d.sum_a[0];
  const Vec3<T> theta =
      add_cross(add_cross(d.theta[0], n, wide<T>(table.assistance_n)), f, wide<T>(table.assistance_f));
  d.state.turn[0] = add_transpose_times(d.state.turn[0], wide<T>(root.R), theta);
  if (root.placed) {
    d.state.p += d.p[0];
    d.state.v += d.v[0];
  }
  d.assistance.n += n;
  d.assistance.f += f;
}

/// Derivatives by the residuals of the targets, from those by joint torques.
template <class T>
void targets_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  for (int i = 1; i < kBodies; ++i) {
    const Vec3<T> torque = d.torque[i];
    const int first = first_dof(i), count = is_hinge(i) ? 1 : 3;
    for (int dof = first; dof < first + count; ++dof) {
      const auto add = [&](const Vec3<RealOf<T>>& by, T& sum) {
        sum = fma(T(by.x), torque.x, fma(T(by.y), torque.y, fma(T(by.z), torque.z, sum)));
      };
      add(table.drive_from[dof], d.from[dof]);
      add(table.drive_to[dof], d.to[dof]);
    }
  }
}

/// Joints that are at their bound in some solve: only the law's part of the torque depends on the targets.
template <class T>
void laws_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  for (const LawTable<RealOf<T>>& law : table.law) {
    const int i = law.body;
    d.torque[i] = d.law[i];  // the table of the body has law and range combined
    const Vec3<T> range = d.range[i] - d.law[i];
    const Vec3<T> spin = T(-law.range_damping) * range;
    d.state.spin[i] = add_transpose_times(d.state.spin[i], wide<T>(table.body[i].R), spin);
    d.state.turn[i] = add_transpose_times(d.state.turn[i], wide<T>(law.range_stiffness), range);
  }
}

}  // namespace

template <class T>
void step_adjoint(const SubstepTable<RealOf<T>>& table, AdjointData<T>& d) {
  integration_adjoint(table, d);
  solves_adjoint(table, d);
  for (const SelfPairTable<RealOf<T>>& pair : table.pairs) self_contact_adjoint(pair, d);
  laws_adjoint(table, d);
  kinematics_adjoint(table, d);
  root_adjoint(table, d);
  targets_adjoint(table, d);
}

template void step_adjoint<double>(const SubstepTable<double>&, AdjointData<double>&);
template void step_adjoint<Pack<kLanes>>(const SubstepTable<float>&, AdjointData<Pack<kLanes>>&);

}  // namespace mimicx::control
