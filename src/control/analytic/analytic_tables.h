/// Numbers of one nominal physics step from which its derivative is computed, the same for every row.
///                                                                             docs/control_derivatives.md §3
///
/// Vectors and matrices are in world-parallel axes about the body's own joint centre, as in physics/data.h,
/// unless a comment names a body frame. D is the change as seen by an observer who turns with the body
/// (docs/control_derivatives.md §2, (2)). Accelerations a count against free fall, a − g. Everything is
/// computed in double (analytic_step.h) and kept as Real, the scalar of the rows' lanes.
#pragma once

#include "core/containers.h"
#include "core/so3.h"
#include "physics/data.h"

namespace mimicx::control {

using namespace physics;  // states, targets and lanes are the simulator's

/// One body and its joint; what all solves of the step share.
template <class Real>
struct BodyTable {
  Mat3<Real> R;               ///< body to world
  Vec3<Real> r;               ///< joint centre minus the parent's, m
  Vec3<Real> w, w_joint;      ///< angular velocity; the joint's part of it, R ω
  Vec3<Real> w_x_r;           ///< ω_λ × r
  Mat3<Real> centripetal;     ///< −ω_λ × (ω_λ × r) by ω_λ
  Mat3<Real> rate_n, rate_f;  ///< −(moment, force) of the rigid body by ω
  Vec3<Real> axis;            ///< of a hinge
  Mat3<Real> stiffness;       ///< torque of PD and range by the joint's rotation δ (body frame)
  Real damping;               ///< torque of PD and range by −R δω
  Mat3<Real> turn;            ///< rotation after the step by the one before, body frames
  Mat3<Real> turn_by_omega;   ///< … and by the velocity after the step, s
  bool placed;                ///< it, or a body that it carries, has a contact: its place matters
};

/// A joint that is at its torque bound in some solve of the step: the range's part of its torque, which has
/// no bound, and δ of its PD controller.
template <class Real>
struct LawTable {
  int body;
  Mat3<Real> range_stiffness;
  Real range_damping, delta;
};

/// Two capsules that push each other apart: D of the wrenches that their bodies i and j feel, by θ, Dω, dv,
/// dp of i and of j.
template <class Real>
struct SelfPairTable {
  int i, j;
  Real wrench[12][24];  ///< (moment; force) of i, then of j
};

/// Floor contacts of one body in one solve: D of the wrench they give, by θ, Dω, dv, dp_z of the body and Dα,
/// Da of the body in the solve before, apart from this solve's accelerations, which the articulated inertia
/// contains.
template <class Real>
struct FloorTable {
  static constexpr int kInputs = 16;
  int body;
  Real wrench[6][kInputs];  ///< (moment; force)
};

/// One body in one solve. For a ball joint D = A + δ is inverted; a hinge uses U and D_inv.xx.
template <class Real>
struct SolveBodyTable {
  Vec3<Real> alpha, a;     ///< acceleration of the body
  Vec3<Real> n, f;         ///< moment and force that the joint transmits
  Sym3<Real> A, C, D_inv;  ///< articulated inertia [A B; Bᵀ C]
  Mat3<Real> B;
  Vec3<Real> U_n, U_f;
  Real delta;
};

/// A joint at its torque bound in one solve.
template <class Real>
struct SaturatedTable {
  int body;
  bool set;               ///< true: the torque follows the law at the solve before; false: it keeps its value
  Sym3<Real> projection;  ///< torque by law: limit/‖law‖ (1 − l lᵀ)
};

/// One solve of the step for accelerations.
template <class Real>
struct SolveTable {
  PerBody<SolveBodyTable<Real>> body;
  Sym3<Real> root_C_inv, root_A_inv;  ///< of the root: C⁻¹; Schur complement's inverse
  Mat3<Real> root_M;                  ///< C⁻¹ Bᵀ
  List<FloorTable<Real>> floor;
  List<SaturatedTable<Real>> saturated;
  PerBody<bool> wanted;  ///< bodies whose accelerations the next solve or the step uses
};

/// One physics step.
template <class Real>
struct SubstepTable {
  Real dt;
  PerBody<BodyTable<Real>> body;
  Array<Vec3<Real>, kDofs> drive_from, drive_to;  ///< torque by residual of the old and the new target
  List<LawTable<Real>> law;
  List<SelfPairTable<Real>> pairs;
  Vec3<Real> assistance_n, assistance_f;  ///< external wrench on the pelvis
  List<SolveTable<Real>> solves;
  int solve_count;  ///< entries of `solves` in use; the others keep their memory

  const SolveTable<Real>& solve(int k) const { return solves[k]; }
};

/// The PD target of one step, and how its rotations turn with the residuals of the frame's old and new
/// target: q*·exp(ε), ε = from · dw + to · du, child's frame. Entries 0 unused.
struct StepTarget {
  Target<double> target;
  PerBody<Matrix3d> from, to;
};

}  // namespace mimicx::control
