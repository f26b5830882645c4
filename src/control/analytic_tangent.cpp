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

/// Positions, velocities, velocity products and joint torques, root to tip.
template <class T>
[[gnu::flatten]] void kinematics(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  for (std::size_t i = 0; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Mat3<T> R = wide<T>(b.R);
    const Vec3<T> turn = R * d.state.turn[i], spin = R * d.state.spin[i];
    if (i == 0) {
      d.theta[0] = turn;
      d.p[0] = d.state.p;
      d.w[0] = cross(turn, wide<T>(b.w)) + spin;
      d.v[0] = d.state.v;
    } else {
      const auto lambda = static_cast<std::size_t>(kParents[i]);
      const Vec3<T> r = wide<T>(b.r), w_joint = wide<T>(b.w_joint), w_lambda = wide<T>(table.body[lambda].w);
      const Vec3<T> theta = d.theta[lambda] + turn;
      const Vec3<T> dr = cross(d.theta[lambda], r);
      const Vec3<T> dw_joint = cross(theta, w_joint) + spin;
      const Vec3<T> dw_x_r = cross(d.w[lambda], r) + cross(w_lambda, dr);
      d.theta[i] = theta;
      d.p[i] = d.p[lambda] + dr;
      d.w[i] = d.w[lambda] + dw_joint;
      d.v[i] = d.v[lambda] + dw_x_r;
      d.c_w[i] = cross(d.w[lambda], w_joint) + cross(w_lambda, dw_joint);
      d.c_v[i] = cross(d.w[lambda], wide<T>(b.w_x_r)) + cross(w_lambda, dw_x_r);
      d.torque[i] = add_scaled(d.drive[i] + wide<T>(b.stiffness) * d.state.turn[i], T(-b.damping), spin);
    }
    d.rate[i] = {wide<T>(b.rate_n) * d.w[i], wide<T>(b.rate_f) * d.w[i]};
  }
  d.rate[0].n -= d.push.n;
  d.rate[0].f -= d.push.f;
  for (const LawTable<RealOf<T>>& law : table.law) {
    const auto i = static_cast<std::size_t>(law.body);
    const Vec3<T> spin = wide<T>(table.body[i].R) * d.state.spin[i];
    d.law[i] = add_scaled(d.drive[i] + wide<T>(law.stiffness) * d.state.turn[i], T(-law.damping), spin);
    d.range[i] = add_scaled(wide<T>(law.range_stiffness) * d.state.turn[i], T(-law.range_damping), spin);
  }
}

/// Change of a penalty force between two capsules.
template <class T>
[[gnu::flatten]] void add_self_contact(const SubstepTable<RealOf<T>>& table,
                                       const SelfPairTable<RealOf<T>>& pair, TangentData<T>& d) {
  const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
  const Vec3<T> u = wide<T>(pair.axis_i), w = wide<T>(pair.axis_j);
  const Vec3<T> du = cross(d.theta[i], u), dw = cross(d.theta[j], w);
  const Vec3<T> dr = (d.p[i] + cross(d.theta[i], wide<T>(pair.start_i))) -
                     (d.p[j] + cross(d.theta[j], wide<T>(pair.start_j)));
  const Vec3<T> r = wide<T>(pair.apart);
  const T u_w = dot(du, w) + dot(u, dw), w_r = dot(dw, r) + dot(w, dr), u_r = dot(du, r) + dot(u, dr);
  const T ds = fma(T(pair.s[0]), u_w, fma(T(pair.s[1]), w_r, T(pair.s[2]) * u_r));
  const T dt = fma(T(pair.t[0]), u_w, fma(T(pair.t[1]), w_r, T(pair.t[2]) * u_r));
  const Vec3<T> on_i = add_scaled(d.p[i] + cross(d.theta[i], wide<T>(pair.on_i)), ds, u);
  const Vec3<T> on_j = add_scaled(d.p[j] + cross(d.theta[j], wide<T>(pair.on_j)), dt, w);
  const Vec3<T> gap = on_i - on_j, n = wide<T>(pair.normal);
  const T distance = dot(n, gap);
  const Vec3<T> dn = T(pair.inverse_distance) * add_scaled(gap, -distance, n);
  const Vec3<T> point = add_scaled(add_scaled(on_j, T(pair.reach), dn), T(0.5) * distance, n);
  const Vec3<T> arm_i = wide<T>(pair.arm_i), arm_j = wide<T>(pair.arm_j);
  const Vec3<T> darm_i = point - d.p[i], darm_j = point - d.p[j];
  const Vec3<T> w_i = wide<T>(table.body[i].w), w_j = wide<T>(table.body[j].w);
  const Vec3<T> dv = (d.v[i] + cross(d.w[i], arm_i) + cross(w_i, darm_i)) -
                     (d.v[j] + cross(d.w[j], arm_j) + cross(w_j, darm_j));
  const T closing = dot(dv, n) + dot(wide<T>(pair.velocity), dn);
  const T push = -fma(T(table.self_stiffness), distance, T(table.self_damping) * closing);
  const Vec3<T> f = wide<T>(pair.force), df = add_scaled(push * n, T(pair.push), dn);
  d.rate[i].f -= df;
  d.rate[i].n -= cross(darm_i, f) + cross(arm_i, df);
  d.rate[j].f += df;
  d.rate[j].n += cross(darm_j, f) + cross(arm_j, df);
}

/// Change of the forces of the floor contacts of a body.
template <class T>
[[gnu::flatten]] void add_floor(const FloorTable<RealOf<T>>& floor, TangentData<T>& d, bool first) {
  const auto i = static_cast<std::size_t>(floor.body);
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
    const auto i = static_cast<std::size_t>(law.body);
    d.torque[i] = d.range[i] + d.law[i];
    for (const SaturatedTable<RealOf<T>>& joint : solve.saturated) {
      if (joint.body != law.body) continue;
      if (joint.set) d.held[i] = wide<T>(joint.projection) * add_scaled(d.law[i], T(-law.delta), d.qdd[i]);
      d.torque[i] = d.range[i] + d.held[i];
    }
  }
}

/// Bias forces, tip to root.
template <class T>
[[gnu::flatten]] void bias_pass(const SubstepTable<RealOf<T>>& table, const SolveTable<RealOf<T>>& solve,
                                TangentData<T>& d) {
  for (std::size_t i = kBodies - 1; i > 0; --i) {
    const auto lambda = static_cast<std::size_t>(kParents[i]);
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const BodyTable<RealOf<T>>& b = table.body[i];
    const Vec3<T> theta = d.theta[i];
    const Vec3<T> c_w = d.c_w[i] + cross(theta, wide<T>(s.qdd));
    const Vec3<T> c_v = d.c_v[i] + cross(wide<T>(solve.body[lambda].alpha), d.p[i] - d.p[lambda]);
    const Vec3<T> t = d.torque[i] + cross(theta, wide<T>(s.n));
    const Mat3<T> B = wide<T>(s.B);
    d.c_w_now[i] = c_w;
    d.c_v_now[i] = c_v;
    const Wrench<T>& own = d.force[i];
    Wrench<T> handed;
    if (is_hinge(static_cast<int>(i))) {
      const Vec3<T> axis = wide<T>(b.axis);
      const Vec3<T> h = own.n + wide<T>(s.A) * c_w + B * c_v;
      const T y = T(s.D_inv.xx) * dot(axis, t - h);
      d.free[i] = add_scaled(c_w, y, axis);
      handed.n = add_scaled(h, y, wide<T>(s.U_n));
      handed.f = add_scaled(own.f + transpose_times(B, c_w) + wide<T>(s.C) * c_v, y, wide<T>(s.U_f));
    } else {
      const T delta(s.delta);
      const Vec3<T> z = wide<T>(s.D_inv) * (add_scaled(t - own.n, delta, c_w) - B * c_v);
      d.free[i] = z;
      handed.n = add_scaled(t, delta, c_w - z);
      handed.f = own.f + transpose_times(B, z) + wide<T>(s.C) * c_v;
    }
    d.force[lambda].f += handed.f;
    d.force[lambda].n += handed.n + cross(wide<T>(b.r), handed.f);
  }
}

/// Accelerations, root to tip, of the bodies that somebody asks for.
template <class T>
[[gnu::flatten]] void acceleration_pass(const SubstepTable<RealOf<T>>& table,
                                        const SolveTable<RealOf<T>>& solve, TangentData<T>& d) {
  const Mat3<T> M = wide<T>(solve.root_M);
  const Vec3<T> right = transpose_times(M, d.force[0].f) - d.force[0].n;
  d.alpha[0] = wide<T>(solve.root_A_inv) * right;
  d.a[0] = -(wide<T>(solve.root_C_inv) * d.force[0].f) - M * d.alpha[0];
  d.qdd[0] = d.alpha[0] - cross(d.theta[0], wide<T>(solve.body[0].alpha));
  for (std::size_t i = 1; i < kBodies; ++i) {
    if (!solve.wanted[i]) continue;
    const auto lambda = static_cast<std::size_t>(kParents[i]);
    const SolveBodyTable<RealOf<T>>& s = solve.body[i];
    const Vec3<T>& alpha = d.alpha[lambda];
    const Vec3<T> a = d.a[lambda] + cross(alpha, wide<T>(table.body[i].r));
    if (is_hinge(static_cast<int>(i))) {
      const T y = T(s.D_inv.xx) * (dot(wide<T>(s.U_n), alpha) + dot(wide<T>(s.U_f), a));
      d.alpha[i] = add_scaled(alpha + d.free[i], -y, wide<T>(table.body[i].axis));
    } else {
      const Vec3<T> right_i = T(s.delta) * alpha - wide<T>(s.B) * a;
      d.alpha[i] = d.free[i] + wide<T>(s.D_inv) * right_i;
    }
    d.a[i] = a + d.c_v_now[i];
    d.qdd[i] = d.alpha[i] - alpha - d.c_w_now[i];
  }
}

template <class T>
void solve_once(const SubstepTable<RealOf<T>>& table, std::size_t index, TangentData<T>& d) {
  const SolveTable<RealOf<T>>& solve = table.solves[index];
  bound_torques(table, solve, d);
  if (!solve.wanted[0]) return;
  for (std::size_t i = 0; i < kBodies; ++i)
    d.force[i] = {d.rate[i].n + wide<T>(solve.body[i].turn_n) * d.theta[i],
                  d.rate[i].f + wide<T>(solve.body[i].turn_f) * d.theta[i]};
  for (const FloorTable<RealOf<T>>& floor : solve.floor) add_floor(floor, d, index == 0);
  bias_pass(table, solve, d);
  acceleration_pass(table, solve, d);
}

/// docs/physics.md §6
template <class T>
[[gnu::flatten]] void integrate(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  const T dt(table.dt);
  StateTangent<T>& x = d.state;
  x.v = add_scaled(x.v, dt, d.a[0]);
  x.p = add_scaled(x.p, dt, x.v);
  for (std::size_t i = 0; i < kBodies; ++i) {
    const BodyTable<RealOf<T>>& b = table.body[i];
    x.spin[i] = add_scaled(x.spin[i], dt, transpose_times(wide<T>(b.R), d.qdd[i]));
    x.turn[i] = wide<T>(b.turn) * x.turn[i] + wide<T>(b.turn_by_omega) * x.spin[i];
  }
}

}  // namespace

template <class T>
void advance_tangent(const SubstepTable<RealOf<T>>& table, TangentData<T>& d) {
  kinematics(table, d);
  for (const SelfPairTable<RealOf<T>>& pair : table.pairs) add_self_contact(table, pair, d);
  for (std::size_t k = 0; k < table.solve_count; ++k) solve_once(table, k, d);
  integrate(table, d);
}

template void advance_tangent<double>(const SubstepTable<double>&, TangentData<double>&);
template void advance_tangent<Pack<8>>(const SubstepTable<float>&, TangentData<Pack<8>>&);
template void advance_tangent<Pack<16>>(const SubstepTable<float>&, TangentData<Pack<16>>&);
#if !defined(__AVX2__)
template void advance_tangent<Pack<4>>(const SubstepTable<float>&, TangentData<Pack<4>>&);
#endif

}  // namespace mimicx::control
