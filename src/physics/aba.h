/// The articulated-body algorithm.                                              RBDA chapter 7, table 7.1
///
/// Three passes: kinematics (kinematics.h), inertia tip-to-root, accelerations root-to-tip. Deviations from
/// the book, all derived in docs/physics.md §2:
///  - world-parallel axes about the body's own joint centre and classical accelerations, so that X is a
///    translation and a ball joint's S is [1; 0];
///  - D carries an extra diagonal δ (armature and the implicit part of PD and range torques), and for a ball
///    joint this simplifies  Ia = IA − U D⁻¹ Uᵀ  to  [δ − δ²D⁻¹, δ D⁻¹ B; ·, C − Bᵀ D⁻¹ B];
///  - IA and pA start from the rigid body plus its floor contacts.
///
/// `articulated_body_algorithm` is the table as the book has it. `solve`, behind it, is the same with a
/// shortcut for the several solves of a step: bodies whose IA and pA would come out as before keep them.
#pragma once

#include "physics/contact.h"
#include "physics/joint_torques.h"
#include "physics/kinematics.h"

namespace mimicx::physics {

/// IA, pA of body i before its children and contacts: those of the rigid body.   RBDA table 7.1, pass 1
template <class T>
void initialise_body(const Model<RealOf<T>>& model, int i, Data<T>& d) {
  const T zero(0.0), m(model.mass[i]);
  const Vec3<T> h = m * d.com[i];
  d.IA[i].A = d.I_o[i];
  d.IA[i].B = {{{zero, h.z, -h.y}, {-h.z, zero, h.x}, {h.y, -h.x, zero}}};  // h×
  d.IA[i].C = {m, zero, zero, m, zero, m};
  d.pA[i] = d.bias[i];
}

/// Adds the floor contacts to IA, pA of their bodies.                            docs/physics.md §4, (9)
template <class T>
void add_floor_contacts(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int k = 0; k < d.ground_count; ++k) {
    const GroundContact<T>& contact = d.ground[k];
    const int i = model.contacts[contact.index].body;
    add_ground(contact, d.IA[i], d.pA[i]);
  }
}

/// Adds the inertia Ia and bias pa of a child, given about the child's joint centre, to its parent, whose
/// joint centre is −r away:  λX*ᵢ Ia ᵢXλ  and  λX*ᵢ pa.           RBDA table 7.1; docs/physics.md §2, (4)
template <class T>
void add_to_parent(const Inertia<T>& Ia, const Wrench<T>& pa, const Vec3<T>& r, Inertia<T>& IA,
                   Wrench<T>& pA) {
  // B' = B + r×C (column by column); A' = A + r×Bᵀ + (r×Bᵀ)ᵀ + r×C(r×)ᵀ = A + r×Bᵀ − B' r×, symmetric.
  const Sym3<T>& C = Ia.C;
  const Mat3<T>& B = Ia.B;
  const Mat3<T> rC = {{cross(r, Vec3<T>{C.xx, C.xy, C.xz}), cross(r, Vec3<T>{C.xy, C.yy, C.yz}),
                       cross(r, Vec3<T>{C.xz, C.yz, C.zz})}};
  const Mat3<T> Bp = {{B.c[0] + rC.c[0], B.c[1] + rC.c[1], B.c[2] + rC.c[2]}};
  // r× Bᵀ: its column j is r × (row j of B).
  const Vec3<T> row0 = {B.c[0].x, B.c[1].x, B.c[2].x}, row1 = {B.c[0].y, B.c[1].y, B.c[2].y},
                row2 = {B.c[0].z, B.c[1].z, B.c[2].z};
  const Vec3<T> g0 = cross(r, row0), g1 = cross(r, row1), g2 = cross(r, row2);
  // −B' r×: its row i is r × (row i of B'), because rowᵀ r× = −(r × row)ᵀ.
  const Vec3<T> e0 = cross(r, Vec3<T>{Bp.c[0].x, Bp.c[1].x, Bp.c[2].x});
  const Vec3<T> e1 = cross(r, Vec3<T>{Bp.c[0].y, Bp.c[1].y, Bp.c[2].y});
  const Vec3<T> e2 = cross(r, Vec3<T>{Bp.c[0].z, Bp.c[1].z, Bp.c[2].z});
  IA.A += Sym3<T>{Ia.A.xx + (g0.x + e0.x), Ia.A.xy + (g1.x + e0.y), Ia.A.xz + (g2.x + e0.z),
                  Ia.A.yy + (g1.y + e1.y), Ia.A.yz + (g2.y + e1.z), Ia.A.zz + (g2.z + e2.z)};
  for (int k = 0; k < 3; ++k) IA.B.c[k] += Bp.c[k];
  IA.C += C;
  pA.f += pa.f;
  pA.n += pa.n + cross(r, pa.f);
}

/// C − Bᵀ M for symmetric results of that form (M = D⁻¹B).
template <class T>
Sym3<T> schur(const Sym3<T>& C, const Mat3<T>& B, const Mat3<T>& M) {
  return C - Sym3<T>{dot(B.c[0], M.c[0]), dot(B.c[0], M.c[1]), dot(B.c[0], M.c[2]),
                     dot(B.c[1], M.c[1]), dot(B.c[1], M.c[2]), dot(B.c[2], M.c[2])};
}

/// Ia, pa of a body with a ball joint.           RBDA eqs. 7.23, 7.24; their form: docs/physics.md §2, (3)
template <class T>
void ball_joint_inertia(int i, Data<T>& d, Inertia<T>& Ia, Wrench<T>& pa) {
  const Inertia<T>& IA = d.IA[i];
  const T delta = d.delta[i];
  d.D_inv[i] = inverse(add_diagonal(IA.A, delta));  // D = SᵀU + δ
  d.u[i] = d.tau[i] + d.tau_range[i] - d.pA[i].n;   // u = τ − SᵀpA
  const Mat3<T> M = d.D_inv[i] * IA.B;              // D⁻¹B
  const T minus_delta_2 = -(delta * delta);
  Ia.A = {fma(minus_delta_2, d.D_inv[i].xx, delta),
          minus_delta_2 * d.D_inv[i].xy,
          minus_delta_2 * d.D_inv[i].xz,
          fma(minus_delta_2, d.D_inv[i].yy, delta),
          minus_delta_2 * d.D_inv[i].yz,
          fma(minus_delta_2, d.D_inv[i].zz, delta)};
  Ia.B = {{delta * M.c[0], delta * M.c[1], delta * M.c[2]}};
  Ia.C = schur(IA.C, IA.B, M);
  // pa = pA + Ia c + U D⁻¹u; U = [A; Bᵀ] and A D⁻¹u = u − δ D⁻¹u.
  const Vec3<T> y = d.D_inv[i] * d.u[i];
  pa.n = d.pA[i].n + Ia.A * d.c_w[i] + Ia.B * d.c_v[i] + add_scaled(d.u[i], -delta, y);
  pa.f = d.pA[i].f + transpose_times(Ia.B, d.c_w[i]) + Ia.C * d.c_v[i] + transpose_times(IA.B, y);
}

/// Ia, pa of a body with a hinge, S = [axis; 0]: the book's rank-one update.     RBDA eqs. 7.23, 7.24
template <class T>
void hinge_inertia(const Vec3<T>& axis, int i, Data<T>& d, Inertia<T>& Ia, Wrench<T>& pa) {
  const Inertia<T>& IA = d.IA[i];
  const Vec3<T> U_n = IA.A * axis, U_f = transpose_times(IA.B, axis);  // U = IA S
  const T D_inv = T(1.0) / (dot(axis, U_n) + d.delta[i]);
  const T u = dot(axis, d.tau[i] + d.tau_range[i] - d.pA[i].n);
  d.D_inv[i].xx = D_inv;
  d.u[i].x = u;
  const Vec3<T> n = D_inv * U_n, f = D_inv * U_f;
  Ia.A = IA.A - Sym3<T>{n.x * U_n.x, n.x * U_n.y, n.x * U_n.z, n.y * U_n.y, n.y * U_n.z, n.z * U_n.z};
  Ia.B = {
      {add_scaled(IA.B.c[0], -f.x, U_n), add_scaled(IA.B.c[1], -f.y, U_n), add_scaled(IA.B.c[2], -f.z, U_n)}};
  Ia.C = IA.C - Sym3<T>{f.x * U_f.x, f.x * U_f.y, f.x * U_f.z, f.y * U_f.y, f.y * U_f.z, f.z * U_f.z};
  pa.n = d.pA[i].n + Ia.A * d.c_w[i] + Ia.B * d.c_v[i] + u * n;
  pa.f = d.pA[i].f + transpose_times(Ia.B, d.c_w[i]) + Ia.C * d.c_v[i] + u * f;
}

/// D, u of joint i, and its Ia, pa added to the parent's IA, pA.                 RBDA table 7.1, pass 2
template <class T>
void add_branch_to_parent(const Model<RealOf<T>>& model, int i, Data<T>& d) {
  const int lambda = kParents[i];
  Inertia<T> Ia;
  Wrench<T> pa;
  if (is_hinge(i))
    hinge_inertia(d.R_WB[i] * spread<T>(model.axis[i]), i, d, Ia, pa);
  else
    ball_joint_inertia(i, d, Ia, pa);
  add_to_parent(Ia, pa, d.r[i], d.IA[lambda], d.pA[lambda]);
}

/// Acceleration of the free pelvis: IA a = −pA by the Schur complement of C.   RBDA eq. 9.13, floating base
template <class T>
void solve_root(Data<T>& d) {
  const Inertia<T>& IA = d.IA[0];
  const Sym3<T> C_inv = inverse(IA.C);
  // Columns of Bᵀ are rows of B; M = C⁻¹ Bᵀ.
  const Mat3<T> Bt = {{{IA.B.c[0].x, IA.B.c[1].x, IA.B.c[2].x},
                       {IA.B.c[0].y, IA.B.c[1].y, IA.B.c[2].y},
                       {IA.B.c[0].z, IA.B.c[1].z, IA.B.c[2].z}}};
  const Mat3<T> M = C_inv * Bt;
  const Vec3<T> right = transpose_times(M, d.pA[0].f) - d.pA[0].n;
  d.a_w[0] = inverse(schur(IA.A, Bt, M)) * right;
  d.a_v[0] = -(C_inv * d.pA[0].f) - M * d.a_w[0];
  d.qdd[0] = d.a_w[0];
}

/// Pass 3, root to tip.                                                          RBDA table 7.1
template <class T>
[[gnu::flatten]] void aba_acceleration_pass(const Model<RealOf<T>>& model, Data<T>& d) {
  solve_root(d);
  for (int i = 1; i < kBodies; ++i) {
    const int lambda = kParents[i];
    const Vec3<T> a_w = d.a_w[lambda] + d.c_w[i];  // a' = X a_λ + c
    const Vec3<T> a_v = d.a_v[lambda] + cross(d.a_w[lambda], d.r[i]) + d.c_v[i];
    if (is_hinge(i)) {
      const Vec3<T> axis = d.R_WB[i] * spread<T>(model.axis[i]);
      const Inertia<T>& IA = d.IA[i];
      const T U_a = dot(axis, IA.A * a_w + IA.B * a_v);
      d.qdd[i] = (d.D_inv[i].xx * (d.u[i].x - U_a)) * axis;
    } else {
      const Vec3<T> U_a = d.IA[i].A * a_w + d.IA[i].B * a_v;  // Uᵀa' with U = [A; Bᵀ]
      d.qdd[i] = d.D_inv[i] * (d.u[i] - U_a);
    }
    d.a_w[i] = a_w + d.qdd[i];
    d.a_v[i] = a_v;
  }
}

/// The algorithm: accelerations under the joint torques and contacts as they are linearised now, after
/// `compute_kinematics` and `compute_rigid_bodies` (the rest of pass 1).         RBDA table 7.1
template <class T>
[[gnu::flatten]] void articulated_body_algorithm(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int i = 0; i < kBodies; ++i) initialise_body(model, i, d);
  add_floor_contacts(model, d);
  for (int i = kBodies - 1; i > 0; --i) add_branch_to_parent(model, i, d);
  aba_acceleration_pass(model, d);
}

// The shortcut. IA and pA of a body depend on its own contacts and on the bodies and joints that it carries,
// and on nothing else (docs/physics.md §2, "Solving again"). Where none of these was linearised anew since
// the solve before, the body keeps IA and pA.

/// A body whose branch has an outdated body is outdated itself.
template <class T>
void carry_outdated_to_root(Data<T>& d) {
  for (int i = kBodies - 1; i > 0; --i)
    if (d.outdated[i]) d.outdated[kParents[i]] = true;
}

/// `initialise_body` and `add_floor_contacts` of the outdated bodies; every body with a contact is one.
template <class T>
[[gnu::flatten]] void initialise_outdated(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int i = 0; i < kBodies; ++i)
    if (d.outdated[i]) initialise_body(model, i, d);
  add_floor_contacts(model, d);
}

/// Pass 2 into the outdated bodies.
template <class T>
[[gnu::flatten]] void outdated_inertia_pass(const Model<RealOf<T>>& model, Data<T>& d) {
  for (int i = kBodies - 1; i > 0; --i)
    if (d.outdated[kParents[i]]) add_branch_to_parent(model, i, d);
}

/// The accelerations of `articulated_body_algorithm`, bit by bit. Does nothing if no body is outdated.
template <class T>
void solve(const Model<RealOf<T>>& model, Data<T>& d) {
  carry_outdated_to_root(d);
  if (!d.outdated[kPelvis]) return;
  initialise_outdated(model, d);
  outdated_inertia_pass(model, d);
  aba_acceleration_pass(model, d);
  d.outdated.fill(false);
}

}  // namespace mimicx::physics
