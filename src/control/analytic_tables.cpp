#include "control/analytic_tables.h"

#include <algorithm>

#include "control/analytic_floor.h"
#include "control/analytic_joints.h"
#include "control/analytic_math.h"
#include "control/analytic_self.h"
#include "physics/aba.h"
#include "physics/integration.h"

namespace mimicx::control {
namespace {

/// Geometry of the bodies, and how their forces change with their angular velocity:
/// moment ω × I_o ω, force ω × (ω × h), h = m d.
template <class Real>
void tabulate_bodies(const Model<double>& model, const Data<double>& d, const State<double>& state,
                     SubstepTable<Real>& out) {
  for (std::size_t i = 0; i < kBodies; ++i) {
    BodyTable<Real>& b = out.body[i];
    const Vector3d w = eigen(d.w[i]), h = model.mass[i] * eigen(d.d[i]);
    const Matrix3d I_o = eigen(d.I_o[i]);
    put(b.R, d.R_WB[i]);
    put(b.w, d.w[i]);
    put(b.rate_n, Matrix3d(skew(w) * I_o - skew(I_o * w)));
    put(b.rate_f, Matrix3d(-skew(w.cross(h)) - skew_product(w, h)));
    if (i == 0) continue;
    const auto lambda = static_cast<std::size_t>(kParents[i]);
    put(b.r, d.r[i]);
    put(b.w_joint, Vector3d(eigen(d.R_WB[i]) * eigen(state.omega[i])));
    put(b.w_x_r, Vector3d(eigen(d.w[lambda]).cross(eigen(d.r[i]))));
    if (is_hinge(static_cast<int>(i))) put(b.axis, Vector3d(eigen(d.R_WB[i]) * eigen(model.axis[i])));
  }
}

/// Moment and force of every body by its rotation θ, at the accelerations of this solve: the rigid body and
/// what its children hand on. The rigid body's own force turns with it, but the accelerations and velocities
/// it depends on do not:  dn = θ × n − I_o (θ × α) − h × (θ × a') − N (θ × ω), N by `tabulate_bodies`, and so
/// the force; a' = a − g.
template <class Real>
void tabulate_turning(const Model<double>& model, const Data<double>& d, SolveTable<Real>& out) {
  std::array<Matrix3d, kBodies> turn_n, turn_f;
  for (std::size_t i = 0; i < kBodies; ++i) {
    const Vector3d w = eigen(d.w[i]), alpha = eigen(d.a_w[i]), h = model.mass[i] * eigen(d.d[i]);
    const Vector3d a = eigen(d.a_v[i]) + model.options.gravity * Vector3d::UnitZ();
    const Matrix3d I_o = eigen(d.I_o[i]);
    const Vector3d L = I_o * w, wh = w.cross(h);
    const Vector3d n = I_o * alpha + h.cross(a) + w.cross(L);
    turn_n[i] =
        -skew(n) + I_o * skew(alpha) + skew_product(h, a) + skew(w) * I_o * skew(w) - skew_product(L, w);
    turn_f[i] = skew(Vector3d(h.cross(alpha) - w.cross(wh))) - skew_product(h, alpha) - skew_product(wh, w) -
                skew(w) * skew_product(h, w);
  }
  // A child's force acts at r, which turns with its parent: (θ × r) × f = (r fᵀ − (r·f) 1) θ.
  for (std::size_t i = 1; i < kBodies; ++i) {
    const Inertia<double>& IA = d.IA[i];
    const Vector3d r = eigen(d.r[i]);
    const Vector3d f = eigen(transpose_times(IA.B, d.a_w[i]) + IA.C * d.a_v[i] + d.pA[i].f);
    const Vector3d n = eigen(IA.A * d.a_w[i] + IA.B * d.a_v[i] + d.pA[i].n);
    turn_n[static_cast<std::size_t>(kParents[i])] += skew_product(f, r);
    put(out.body[i].n, n);
  }
  for (std::size_t i = 0; i < kBodies; ++i) {
    put(out.body[i].turn_n, turn_n[i]);
    put(out.body[i].turn_f, turn_f[i]);
  }
}

/// Articulated inertias and accelerations of one solve.
template <class Real>
void tabulate_inertias(const Model<double>& model, const Data<double>& d, SolveTable<Real>& out) {
  for (std::size_t i = 0; i < kBodies; ++i) {
    SolveBodyTable<Real>& b = out.body[i];
    const Inertia<double>& IA = d.IA[i];
    put(b.qdd, d.qdd[i]);
    put(b.alpha, d.a_w[i]);
    put(b.A, IA.A);
    put(b.B, IA.B);
    put(b.C, IA.C);
    if (i == 0) continue;
    put(b.D_inv, d.D_inv[i]);
    b.delta = static_cast<Real>(d.delta[i]);
    if (is_hinge(static_cast<int>(i))) {
      const Vec3<double> axis = d.R_WB[i] * model.axis[i];
      put(b.U_n, IA.A * axis);
      put(b.U_f, transpose_times(IA.B, axis));
    }
  }
  // solve_root of physics/aba.h
  const Inertia<double>& root = d.IA[0];
  const Matrix3d B = eigen(root.B), C_inv = eigen(inverse(root.C)), M = C_inv * B.transpose();
  put(out.root_C_inv, C_inv);
  put(out.root_M, M);
  Sym3<double> complement;
  put(complement, Matrix3d(eigen(root.A) - B * M));
  put(out.root_A_inv, inverse(complement));
}

/// Marks a body and those between it and the root.
void want(std::size_t body, std::array<bool, kBodies>& wanted) {
  for (std::size_t i = body; !wanted[i]; i = static_cast<std::size_t>(kParents[i])) {
    wanted[i] = true;
    if (i == 0) return;
  }
}

/// The solves of one step, in the order of `solve_accelerations`.
template <class Real>
struct Solves {
  const Model<double>& model;
  Data<double>& d;
  SubstepTable<Real>& out;
  ContactVelocities linearised;
  Accelerations before;

  /// Solves, and tabulates that unless nothing has changed since the solve before.
  void solve_and_tabulate() {
    const bool anew = std::find(d.changed.begin(), d.changed.end(), true) != d.changed.end();
    if (!anew) return;
    const bool first = out.solve_count == 0;
    before = {d.a_w, d.a_v};
    solve(model, d);
    if (out.solve_count == out.solves.size()) out.solves.emplace_back();
    SolveTable<Real>& table = out.solves[out.solve_count++];
    tabulate_turning(model, d, table);
    tabulate_inertias(model, d, table);
    tabulate_floor(model, d, linearised, first ? nullptr : &before, table.floor);
    table.wanted.fill(true);
    if (first) return;
    auto& wanted = out.solves[out.solve_count - 2].wanted;
    wanted.fill(false);
    for (const FloorTable<Real>& floor : table.floor) want(static_cast<std::size_t>(floor.body), wanted);
    for (const SaturatedTable<Real>& joint : table.saturated)
      if (joint.set && !is_hinge(joint.body)) want(static_cast<std::size_t>(joint.body), wanted);
  }

  /// The table that the next solve will fill.
  SolveTable<Real>& next() {
    if (out.solve_count == out.solves.size()) out.solves.emplace_back();
    return out.solves[out.solve_count];
  }

  void run() {
    out.solve_count = 0;
    next().saturated.clear();
    velocities_at_start(d, linearised);
    d.changed.fill(true);
    solve_and_tabulate();
    std::array<bool, kBodies> kept{};
    for (int pass = 1; pass < model.options.passes; ++pass) {
      predicted_velocities(model, d, linearised);
      relinearise_ground(model, true, d);
      apply_torque_bounds(model, d);
      tabulate_saturated(model, d, kept, next().saturated);
      solve_and_tabulate();
    }
    kept = d.saturated;
    while (saturate_exceeding(model, d)) {
      predicted_velocities(model, d, linearised);
      relinearise_ground(model, true, d);
      tabulate_saturated(model, d, kept, next().saturated);
      solve_and_tabulate();
      kept = d.saturated;
    }
  }
};

}  // namespace

template <class Real>
bool tabulate_step(const Model<double>& model, const Target<double>& target, const TargetDerivative& turns,
                   const Wrench<double>& push, State<double>& state, Data<double>& d,
                   SubstepTable<Real>& out) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  d.self_wrench.fill({zero3<double>(), zero3<double>()});
  if (model.options.self_contact) add_self_contact(model, d);
  d.bias[0].n -= push.n;
  d.bias[0].f -= push.f;
  detect_ground(model, d);
  compute_joint_torques(model, state, target, d);
  use_pd_law(model, d);

  out.dt = static_cast<Real>(model.dt);
  out.self_stiffness = static_cast<Real>(model.options.self_stiffness);
  out.self_damping = static_cast<Real>(model.options.self_damping);
  tabulate_bodies(model, d, state, out);
  tabulate_self_contact(model, d, out.pairs);
  Solves<Real> solves{model, d, out, {}, {}};
  solves.run();
  tabulate_joints(model, state, target, turns, d, out);
  integrate(model, d, state);
  tabulate_integration(model, state, out);
  return gone_wrong(model, state);
}

template bool tabulate_step(const Model<double>&, const Target<double>&, const TargetDerivative&,
                            const Wrench<double>&, State<double>&, Data<double>&, SubstepTable<float>&);
template bool tabulate_step(const Model<double>&, const Target<double>&, const TargetDerivative&,
                            const Wrench<double>&, State<double>&, Data<double>&, SubstepTable<double>&);

}  // namespace mimicx::control
