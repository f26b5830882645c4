/// What the derivative of one physics step needs to know of the step itself: numbers of the nominal
/// motion, the same for every direction of differentiation.             docs/control_derivatives.md §2, §3
///
/// Vectors and matrices are in world-parallel axes about the body's own joint centre, as in
/// physics/data.h, unless a comment names a body frame. Everything is computed in double
/// (analytic_tables.cpp) and kept as Real, the scalar of the directions' lanes.
#pragma once

#include <array>
#include <vector>

#include "core/so3.h"
#include "physics/data.h"

namespace mimicx::control {

/// One body and its joint; what all solves of the step share.
template <class Real>
struct BodyTable {
  Mat3<Real> R;               ///< body to world
  Vec3<Real> r;               ///< joint centre minus the parent's, m
  Vec3<Real> w, w_joint;      ///< angular velocity; the joint's part of it, R ω
  Vec3<Real> w_x_r;           ///< ω_λ × r
  Mat3<Real> rate_n, rate_f;  ///< moment, force of the rigid body by its angular velocity
  Vec3<Real> axis;            ///< of a hinge
  Mat3<Real> stiffness;       ///< torque of PD and range by the joint's rotation (body frame)
  Real damping;               ///< torque of PD and range by −R δω
  Mat3<Real> turn,
      turn_by_omega;  ///< rotation after the step by the one before, and by the new velocity; body frames
};

/// A joint that is at its torque bound in some solve of the step: torques of its PD controller's law and of
/// its range apart.
template <class Real>
struct LawTable {
  int body;
  Mat3<Real> stiffness, range_stiffness;
  Real damping, range_damping, delta;
};

/// Two capsules that push each other apart. Names as in `add_self_contact`.
template <class Real>
struct SelfPairTable {
  int i, j;
  Vec3<Real> axis_i, axis_j, start_i, start_j;  ///< starts from the joint centres
  Vec3<Real> apart;                             ///< start of i minus start of j
  Vec3<Real> on_i, on_j;                        ///< closest points from the joint centres
  std::array<Real, 3> s, t;  ///< ds, dt by (d(u·w), d(w·r), d(u·r)) of `closest_on_segments`
  Vec3<Real> normal, arm_i, arm_j, velocity, force;
  Real inverse_distance, reach, push;  ///< reach: from the closest point of j to the common point
};

/// Floor contacts of one body in one solve. The force they give changes by `wrench` times
/// (θ, ω, v, p_z of the body; α, a of the body in the solve before), apart from the accelerations of this
/// solve, which the articulated inertia contains.
template <class Real>
struct FloorTable {
  static constexpr int kInputs = 16;
  int body;
  Real wrench[6][kInputs];  ///< (moment; force), taken from the bias of the body
};

/// One body in one solve. For a ball joint D = A + δ is inverted; a hinge uses U and D_inv.xx.
template <class Real>
struct SolveBodyTable {
  Mat3<Real> turn_n, turn_f;  ///< moment, force by the body's rotation θ at fixed accelerations
  Vec3<Real> qdd;             ///< joint acceleration
  Vec3<Real> alpha;           ///< angular acceleration of the body
  Vec3<Real> n;               ///< moment that the joint transmits
  Sym3<Real> A, C, D_inv;     ///< articulated inertia [A B; Bᵀ C]
  Mat3<Real> B;
  Vec3<Real> U_n, U_f;
  Real delta;
};

/// A joint at its torque bound in one solve.
template <class Real>
struct SaturatedTable {
  int body;
  bool set;               ///< its torque follows the law at the solve before; otherwise it is kept
  Sym3<Real> projection;  ///< torque by law: limit/‖law‖ (1 − l lᵀ)
};

/// One solve of the step for accelerations.
template <class Real>
struct SolveTable {
  std::array<SolveBodyTable<Real>, kBodies> body;
  Sym3<Real> root_C_inv, root_A_inv;  ///< of the root: C⁻¹; Schur complement's inverse
  Mat3<Real> root_M;                  ///< C⁻¹ Bᵀ
  std::vector<FloorTable<Real>> floor;
  std::vector<SaturatedTable<Real>> saturated;
  std::array<bool, kBodies> wanted;  ///< bodies whose accelerations the next solve or the step asks for
};

template <class Real>
struct SubstepTable {
  Real dt;
  std::array<BodyTable<Real>, kBodies> body;
  std::array<Vec3<Real>, kDofs> drive_from, drive_to;  ///< torque by residual of the old and the new target
  std::vector<LawTable<Real>> law;
  std::vector<SelfPairTable<Real>> pairs;
  Real self_stiffness, self_damping;
  std::vector<SolveTable<Real>> solves;
  std::size_t solve_count;  ///< entries of `solves` in use; the others keep their memory
};

/// How a target of one step turns, in the child's frame, with the residual rotations of the frame's old and
/// new target: q*·exp(ε), ε = from · dw + to · du. Entry 0 unused.
struct TargetDerivative {
  std::array<Matrix3d, kBodies> from, to;
};

/// One physics step of the nominal motion, as `step` does it bit by bit where nothing pushes, and everything
/// about it that its derivative needs.
/// @param push  external wrench on the root (moment; force), world axes
/// @return whether the motion ran away
template <class Real>
bool tabulate_step(const Model<double>& model, const Target<double>& target, const TargetDerivative& turns,
                   const Wrench<double>& push, State<double>& state, Data<double>& d,
                   SubstepTable<Real>& out);

}  // namespace mimicx::control
