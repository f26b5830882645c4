#include "control/analytic_tangent.h"

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
/// c − m v
template <class T>
Vec3<T> subtract_times(const Vec3<T>& c, const Mat3<T>& m, const Vec3<T>& v) {
  return add_times(c, m, -v);
}
/// c + mᵀ v
template <class T>
Vec3<T> add_transpose_times(const Vec3<T>& c, const Mat3<T>& m, const Vec3<T>& v) {
  const auto add = [&](T sum, const Vec3<T>& a) { return fma(a.x, v.x, fma(a.y, v.y, fma(a.z, v.z, sum))); };
  return {add(c.x, m.c[0]), add(c.y, m.c[1]), add(c.z, m.c[2])};
}

/// Rotations, velocities, velocity products and joint torques, root to tip.
template <class T>
[[gnu::flatten]] void kinematics(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  for (int i = 0; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Mat3<T> R = wide<T>(b.R);
    const Vec3<T> turn = R * d.state.turn[i], spin = R * d.state.spin[i];
    d.turn[i] = turn;
    if (i == 0) {
      d.theta[0] = turn;
      d.w[0] = spin;
    } else {
      const int lambda = kParents[i];
      const Vec3<T> w_lambda = wide<T>(table.body[lambda].w);
      // The parent's ω as the child sees it, which turns by `turn` more than the parent does.
      const Vec3<T> dw_lambda = add_cross(d.w[lambda], w_lambda, turn);
      d.theta[i] = d.theta[lambda] + turn;
      d.w[i] = dw_lambda + spin;
      d.c_w[i] = add_cross(cross(w_lambda, spin), dw_lambda, wide<T>(b.w_joint));
      d.c_v[i] = wide<T>(b.centripetal) * d.w[lambda];
      d.torque[i] =
          add_scaled(add_times(d.drive[i], wide<T>(b.stiffness), d.state.turn[i]), T(-b.damping), spin);
    }
    d.rate[i].n = wide<T>(b.rate_n) * d.w[i];
    d.rate[i].f = wide<T>(b.rate_f) * d.w[i];
  }
  d.rate[0].n = add_cross(d.rate[0].n, d.theta[0], wide<T>(table.help_n)) - d.help.n;
  d.rate[0].f = add_cross(d.rate[0].f, d.theta[0], wide<T>(table.help_f)) - d.help.f;
  for (const LawTable<RealOf<T>>& law : table.law) {
    const int i = law.body;
    const Vec3<T> spin = wide<T>(table.body[i].R) * d.state.spin[i];
    d.law[i] =
        add_scaled(add_times(d.drive[i], wide<T>(law.stiffness), d.state.turn[i]), T(-law.damping), spin);
    d.range[i] = add_scaled(wide<T>(law.range_stiffness) * d.state.turn[i], T(-law.range_damping), spin);
  }
}

/// World positions and velocities of the joint centres that somebody asks for.
template <class T>
[[gnu::flatten]] void place(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  d.p[0] = d.state.p;
  d.v[0] = d.state.v;
  for (int i = 1; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    if (!b.placed) continue;
    const int lambda = kParents[i];
    const Vec3<T> r = wide<T>(b.r);
    d.p[i] = add_cross(d.p[lambda], d.theta[lambda], r);
    d.v[i] = add_cross(add_cross(d.v[lambda], d.w[lambda], r), d.theta[lambda], wide<T>(b.w_x_r));
  }
}

/// Penalty force between two capsules: `add_self_contact` of physics/contact.h differentiated line by line.
template <class T>
[[gnu::flatten]] void add_self_contact(const SubstepTable<RealOf<T>>& table,
                                       const SelfPairTable<RealOf<T>>& pair, TangentData<T>& d) {
  const int i = pair.i, j = pair.j;
  const Vec3<T>&theta_i = d.theta[i], &theta_j = d.theta[j];
  const Vec3<T> u = wide<T>(pair.axis_i), w = wide<T>(pair.axis_j), r = wide<T>(pair.apart);
  const Vec3<T> du = cross(theta_i, u), dw = cross(theta_j, w);
  const Vec3<T> dr =
      add_cross(d.p[i], theta_i, wide<T>(pair.start_i)) - add_cross(d.p[j], theta_j, wide<T>(pair.start_j));
  const T u_w = dot(du, w) + dot(u, dw), w_r = dot(dw, r) + dot(w, dr), u_r = dot(du, r) + dot(u, dr);
  const T ds = fma(T(pair.s[0]), u_w, fma(T(pair.s[1]), w_r, T(pair.s[2]) * u_r));
  const T dt = fma(T(pair.t[0]), u_w, fma(T(pair.t[1]), w_r, T(pair.t[2]) * u_r));
  const Vec3<T> on_i = add_scaled(add_cross(d.p[i], theta_i, wide<T>(pair.on_i)), ds, u);
  const Vec3<T> on_j = add_scaled(add_cross(d.p[j], theta_j, wide<T>(pair.on_j)), dt, w);
  const Vec3<T> gap = on_i - on_j, n = wide<T>(pair.normal);
  const T distance = dot(n, gap);
  const Vec3<T> dn = T(pair.inverse_distance) * add_scaled(gap, -distance, n);
  const Vec3<T> point = add_scaled(add_scaled(on_j, T(pair.reach), dn), T(0.5) * distance, n);
  const Vec3<T> arm_i = wide<T>(pair.arm_i), arm_j = wide<T>(pair.arm_j);
  const Vec3<T> darm_i = point - d.p[i], darm_j = point - d.p[j];
  const Vec3<T> w_i = wide<T>(table.body[i].w), w_j = wide<T>(table.body[j].w);
  const Vec3<T> dw_i = add_cross(d.w[i], theta_i, w_i), dw_j = add_cross(d.w[j], theta_j, w_j);
  const Vec3<T> dv = add_cross(add_cross(d.v[i], dw_i, arm_i), w_i, darm_i) -
                     add_cross(add_cross(d.v[j], dw_j, arm_j), w_j, darm_j);
  const T closing = dot(dv, n) + dot(wide<T>(pair.velocity), dn);
  const T push = -fma(T(table.self_stiffness), distance, T(table.self_damping) * closing);
  const Vec3<T> f = wide<T>(pair.force), df = add_scaled(push * n, T(pair.push), dn);
  // D of the wrench: what it turns by with the body is taken out.
  d.rate[i].f -= df - cross(theta_i, f);
  d.rate[i].n -= add_cross(cross(darm_i, f), arm_i, df) - cross(theta_i, wide<T>(pair.moment_i));
  d.rate[j].f += df - cross(theta_j, f);
  d.rate[j].n += add_cross(cross(darm_j, f), arm_j, df) - cross(theta_j, wide<T>(pair.moment_j));
}

/// Forces of the floor contacts of a body.
template <class T>
[[gnu::flatten]] void add_floor(const FloorTable<RealOf<T>>& floor, TangentData<T>& d, bool first) {
  const int i = floor.body;
  const T inputs[FloorTable<RealOf<T>>::kInputs] = {
      d.theta[i].x, d.theta[i].y, d.theta[i].z, d.w[i].x,     d.w[i].y,     d.w[i].z, d.v[i].x, d.v[i].y,
      d.v[i].z,     d.p[i].z,     d.alpha[i].x, d.alpha[i].y, d.alpha[i].z, d.a[i].x, d.a[i].y, d.a[i].z};
  const int count = first ? 10 : FloorTable<RealOf<T>>::kInputs;
  T sum[6];
  for (int row = 0; row < 6; ++row) sum[row] = T(floor.wrench[row][0]) * inputs[0];
  for (int k = 1; k < count; ++k)
    for (int row = 0; row < 6; ++row) sum[row] = fma(T(floor.wrench[row][k]), inputs[k], sum[row]);
  d.force[i].n -= Vec3<T>{sum[0], sum[1], sum[2]};
  d.force[i].f -= Vec3<T>{sum[3], sum[4], sum[5]};
}

/// Torques of the joints that are at their bound in some solve: the law, or the constant that replaces it,
/// which follows the law at the solve before the one that set it.
template <class T>
void bound_torques(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& solve,
                   TangentData<T>& d) {
  for (const LawTable<RealOf<T>>& law : table.law) {
    const int i = law.body;
    d.torque[i] = d.range[i] + d.law[i];
    for (const SaturatedTable<RealOf<T>>& joint : solve.saturated) {
      if (joint.body != law.body) continue;
      if (joint.set) d.held[i] = wide<T>(joint.projection) * add_scaled(d.law[i], T(-law.delta), d.qdd[i]);
      d.torque[i] = d.range[i] + d.held[i];
    }
  }
}

/// Bias forces, tip to root. With the parent's accelerations zero a body has Dα = z and Da = c_v, and hands
/// its parent the wrench that this takes.
template <class T>
[[gnu::flatten]] void bias_pass(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& solve,
                                TangentData<T>& d) {
  for (int i = kBodies - 1; i > 0; --i) {
    const int lambda = kParents[i];
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const Vec3<T> turn = d.turn[i];
    const Vec3<T> c_w = add_cross(d.c_w[i], wide<T>(solve.body[lambda].alpha), turn);
    const Vec3<T> c_v = add_cross(d.c_v[i], wide<T>(s.a), turn);
    const Mat3<T> B = wide<T>(s.B);
    const Vec3<T> own_n = d.force[i].n, own_f = d.force[i].f, t = d.torque[i];
    Vec3<T> n, f;
    d.c_w_now[i] = c_w;
    d.c_v_now[i] = c_v;
    if (is_hinge(i)) {
      const Vec3<T> axis = wide<T>(table.body[i].axis);
      const Vec3<T> h = add_times(add_times(own_n, wide<T>(s.A), c_w), B, c_v);
      const T y = T(s.D_inv.xx) * dot(axis, t - h);
      d.free[i] = add_scaled(c_w, y, axis);
      n = add_scaled(h, y, wide<T>(s.U_n));
      f = add_scaled(add_times(add_transpose_times(own_f, B, c_w), wide<T>(s.C), c_v), y, wide<T>(s.U_f));
    } else {
      const T delta(s.delta);
      const Vec3<T> z = wide<T>(s.D_inv) * subtract_times(add_scaled(t - own_n, delta, c_w), B, c_v);
      d.free[i] = z;
      n = add_scaled(t, delta, c_w - z);
      f = add_times(add_transpose_times(own_f, B, z), wide<T>(s.C), c_v);
    }
    n = add_cross(n, turn, wide<T>(s.n));  // as the parent sees it
    f = add_cross(f, turn, wide<T>(s.f));
    d.force[lambda].f += f;
    d.force[lambda].n = add_cross(d.force[lambda].n + n, wide<T>(table.body[i].r), f);
  }
}

/// Accelerations, root to tip, of the bodies that somebody asks for.
template <class T>
[[gnu::flatten]] void acceleration_pass(const SubstepTable<RealOf<T>>& table,
                                        const SolveTable<RealOf<T>>& solve, TangentData<T>& d) {
  const Mat3<T> M = wide<T>(solve.root_M);
  const Vec3<T> right = add_transpose_times(-d.force[0].n, M, d.force[0].f);
  d.alpha[0] = wide<T>(solve.root_A_inv) * right;
  d.a[0] = -add_times(wide<T>(solve.root_C_inv) * d.force[0].f, M, d.alpha[0]);
  d.qdd[0] = d.alpha[0];
  for (int i = 1; i < kBodies; ++i) {
    if (!solve.wanted[i]) continue;
    const int lambda = kParents[i];
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const Vec3<T> alpha_lambda = d.alpha[lambda];
    const Vec3<T> a = add_cross(d.a[lambda], alpha_lambda, wide<T>(table.body[i].r));
    Vec3<T> alpha;
    if (is_hinge(i)) {
      const T y = T(s.D_inv.xx) * (dot(wide<T>(s.U_n), alpha_lambda) + dot(wide<T>(s.U_f), a));
      alpha = add_scaled(alpha_lambda + d.free[i], -y, wide<T>(table.body[i].axis));
    } else {
      const Vec3<T> right_i = subtract_times(T(s.delta) * alpha_lambda, wide<T>(s.B), a);
      alpha = add_times(d.free[i], wide<T>(s.D_inv), right_i);
    }
    d.alpha[i] = alpha;
    d.a[i] = a + d.c_v_now[i];
    d.qdd[i] = alpha - alpha_lambda - d.c_w_now[i];
  }
}

template <class T>
void solve_once(const SubstepTable<RealOf<T>>& table, int index, TangentData<T>& d) {
  const SolveTable<RealOf<T>>& solve = table.solve(index);
  bound_torques(table, solve, d);
  if (!solve.wanted[0]) return;
  d.force = d.rate;
  for (const FloorTable<RealOf<T>>& floor : solve.floor) add_floor(floor, d, index == 0);
  bias_pass(table, solve, d);
  acceleration_pass(table, solve, d);
}

/// docs/physics.md §6
template <class T>
[[gnu::flatten]] void integrate(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& last,
                                TangentData<T>& d) {
  const T dt(table.dt);
  StateTangent<T>& x = d.state;
  x.v = add_scaled(x.v, dt, add_cross(d.a[0], d.theta[0], wide<T>(last.body[0].a)));
  x.p = add_scaled(x.p, dt, x.v);
  for (int i = 0; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Vec3<T> spin = add_scaled(x.spin[i], dt, transpose_times(wide<T>(b.R), d.qdd[i]));
    x.spin[i] = spin;
    x.turn[i] = add_times(wide<T>(b.turn) * x.turn[i], wide<T>(b.turn_by_omega), spin);
  }
}

}  // namespace

template <class T>
void advance_tangent(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  kinematics(table, d);
  place(table, d);
  for (const SelfPairTable<RealOf<T>>& pair : table.pairs) add_self_contact(table, pair, d);
  for (int k = 0; k < table.solve_count; ++k) solve_once(table, k, d);
  integrate(table, table.solve(table.solve_count - 1), d);
}

template void advance_tangent<double>(const SubstepTable<double>&, TangentData<double>&);
template void advance_tangent<Pack<kLanes>>(const SubstepTable<float>&, TangentData<Pack<kLanes>>&);

}  // namespace mimicx::control
