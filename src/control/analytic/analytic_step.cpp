#include "control/analytic/analytic_step.h"

#include <algorithm>

#include "control/analytic/analytic_floor.h"
#include "control/analytic/analytic_joints.h"
#include "control/analytic/analytic_math.h"
#include "control/analytic/analytic_self.h"
#include "physics/aba.h"
#include "physics/integration.h"

namespace mimicx::control {
namespace {

/// Geometry of the bodies, and how their forces change with their angular velocity:
/// moment ω × I_o ω, force ω × (ω × h), h = m d.
template <class Real>
void tabulate_bodies(const Model<double>& model, const Data<double>& d, const State<double>& state,
                     SubstepTable<Real>& out) {
  for (int i = 0; i < kBodies; ++i) {
    BodyTable<Real>& b = out.body[i];
    const Vector3d w = to_eigen(d.w[i]), h = model.mass[i] * to_eigen(d.com[i]);
    const Matrix3d I_o = to_eigen(d.I_o[i]);
    put(b.R, d.R_WB[i]);
    put(b.w, d.w[i]);
    put(b.rate_n, Matrix3d(skew(I_o * w) - skew(w) * I_o));
    put(b.rate_f, Matrix3d(skew(w.cross(h)) + skew_product(w, h)));
    if (i == 0) continue;
    const int lambda = kParents[i];
    put(b.r, d.r[i]);
    put(b.w_joint, Vector3d(to_eigen(d.R_WB[i]) * to_eigen(state.omega[i])));
    const Vector3d w_lambda = to_eigen(d.w[lambda]), r = to_eigen(d.r[i]), w_x_r = w_lambda.cross(r);
    put(b.w_x_r, w_x_r);
    put(b.centripetal, Matrix3d(skew(w_x_r) + skew_product(w_lambda, r)));
    if (is_hinge(i)) put(b.axis, Vector3d(to_eigen(d.R_WB[i]) * to_eigen(model.axis[i])));
  }
}

/// Articulated inertias and accelerations of one solve.
template <class Real>
void tabulate_inertias(const Model<double>& model, const Data<double>& d, SolveTable<Real>& out) {
  for (int i = 0; i < kBodies; ++i) {
    SolveBodyTable<Real>& b = out.body[i];
    const Inertia<double>& IA = d.IA[i];
    put(b.alpha, d.a_w[i]);
    Vec3<double> a = d.a_v[i];
    a.z += model.config.gravity;
    put(b.a, a);
    put(b.n, IA.A * d.a_w[i] + IA.B * d.a_v[i] + d.pA[i].n);
    put(b.f, transpose_times(IA.B, d.a_w[i]) + IA.C * d.a_v[i] + d.pA[i].f);
    put(b.A, IA.A);
    put(b.B, IA.B);
    put(b.C, IA.C);
    if (i == 0) continue;
    put(b.D_inv, d.D_inv[i]);
    b.delta = static_cast<Real>(d.delta[i]);
    if (is_hinge(i)) {
      const Vec3<double> axis = d.R_WB[i] * model.axis[i];
      put(b.U_n, IA.A * axis);
      put(b.U_f, transpose_times(IA.B, axis));
    }
  }
  // solve_root of physics/aba.h
  const Inertia<double>& root = d.IA[0];
  const Matrix3d B = to_eigen(root.B), C_inv = to_eigen(inverse(root.C)), M = C_inv * B.transpose();
  put(out.root_C_inv, C_inv);
  put(out.root_M, M);
  Sym3<double> complement;
  put(complement, Matrix3d(to_eigen(root.A) - B * M));
  put(out.root_A_inv, inverse(complement));
}

/// Marks a body and those between it and the root.
void mark(int body, PerBody<bool>& marked) {
  for (int i = body; i >= 0; i = kParents[i]) marked[i] = true;
}

/// Marks the bodies whose place matters to a contact.
template <class Real>
void mark_placed(SubstepTable<Real>& out) {
  PerBody<bool> placed{};
  for (int k = 0; k < out.solve_count; ++k)
    for (const FloorTable<Real>& floor : out.solve(k).floor) mark(floor.body, placed);
  for (const SelfPairTable<Real>& pair : out.pairs) {
    mark(pair.i, placed);
    mark(pair.j, placed);
  }
  for (int i = 0; i < kBodies; ++i) out.body[i].placed = placed[i];
}

/// The solves of one step, in the order of `solve_accelerations`.
template <class Real>
struct Solves {
  const Model<double>& model;
  Data<double>& d;
  SubstepTable<Real>& out;
  ContactVelocities linearised;
  Accelerations before;

  /// Solves and tabulates the solve, unless no body is outdated since the solve before.
  void solve_and_tabulate() {
    if (std::find(d.outdated.begin(), d.outdated.end(), true) == d.outdated.end()) return;
    const bool first = out.solve_count == 0;
    before = {d.a_w, d.a_v};
    solve(model, d);
    SolveTable<Real>& table = next();
    ++out.solve_count;
    tabulate_inertias(model, d, table);
    tabulate_floor(model, d, linearised, first ? nullptr : &before, table.floor);
    table.wanted.fill(true);
    if (first) return;
    auto& wanted = out.solves[out.solve_count - 2].wanted;
    wanted.fill(false);
    for (const FloorTable<Real>& floor : table.floor) mark(floor.body, wanted);
    for (const SaturatedTable<Real>& joint : table.saturated)
      if (joint.set && !is_hinge(joint.body)) mark(joint.body, wanted);
  }

  /// The table that the next solve will fill.
  SolveTable<Real>& next() {
    const int k = out.solve_count;
    if (k == out.solves.count()) out.solves.emplace_back();
    return out.solves[k];
  }

  void run() {
    out.solve_count = 0;
    next().saturated.clear();
    velocities_at_start(d, linearised);
    d.outdated.fill(true);
    solve_and_tabulate();
    PerBody<bool> kept{};
    for (int pass = 1; pass < model.config.passes; ++pass) {
      predicted_velocities(model, d, linearised);
      relinearise_ground(model, true, d);
      apply_torque_bounds(model, d);
      tabulate_saturated(model, d, kept, next().saturated);
      solve_and_tabulate();
    }
    kept = d.saturated;
    while (correct_torque_bounds(model, d)) {
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
bool tabulate_step(const Model<double>& model, const StepTarget& target, const Wrench<double>& assistance,
                   State<double>& state, Data<double>& d, SubstepTable<Real>& out) {
  compute_kinematics(model, state, d);
  compute_rigid_bodies(model, d);
  d.self_wrench.fill({zero3<double>(), zero3<double>()});
  if (model.config.self_contact) add_self_contact(model, d);
  d.bias[0].n -= assistance.n;
  d.bias[0].f -= assistance.f;
  detect_ground(model, d);
  compute_joint_torques(model, state, target.target, d);
  use_pd_law(model, d);

  out.dt = static_cast<Real>(model.dt);
  put(out.assistance_n, assistance.n);
  put(out.assistance_f, assistance.f);
  tabulate_bodies(model, d, state, out);
  tabulate_self_contact(model, d, out.pairs);
  Solves<Real> solves{model, d, out, {}, {}};
  solves.run();
  mark_placed(out);
  tabulate_joints(model, state, target, d, out);
  integrate(model, d, state);
  tabulate_integration(model, state, out);
  return gone_wrong(model, state);
}

template bool tabulate_step(const Model<double>&, const StepTarget&, const Wrench<double>&, State<double>&,
                            Data<double>&, SubstepTable<float>&);
template bool tabulate_step(const Model<double>&, const StepTarget&, const Wrench<double>&, State<double>&,
                            Data<double>&, SubstepTable<double>&);

}  // namespace mimicx::control
