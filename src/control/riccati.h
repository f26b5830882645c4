/// The linear-quadratic regulator, backwards in time: from the value of the next state to the best control
/// and the value of this one.
///
/// Here the state remembers part of the control before (differences.h): z = (x, w) with
///     x' = F (x, w, u) + gap,      w' = the first entries of u,
/// and the cost of a frame is ½ (z, u)ᵀ H (z, u) + gᵀ (z, u). With the value of the next state
/// ½ z'ᵀ V z' + vᵀ z', the sum of both is a quadratic function Q of (z, u), least at
///     u = k + K z,      K = −Q_uu⁻¹ Q_uz,      k = −Q_uu⁻¹ q_u,
/// and V ← Q_zz − Q_zu Q_uu⁻¹ Q_uz is the value of this one. Without memory (`memory` 0) this is the
/// textbook's regulator (docs/control.md §1, (2)). Source: Tassa, Erez, Todorov, "Synthesis and Stabilization
/// of Complex Behaviors through Online Trajectory Optimization" (2012), eqs. (5), (6); gaps: Mastalli et al.,
/// "Crocoddyl" (2020), §IV-B.
///
/// Nearly all time goes into products of matrices. Their scalar is `Real`; gradients, Q_uu and its root are
/// always in double. Planning takes float, which halves the time and plans as well (docs/control.md).
#pragma once

#include <Eigen/Core>

namespace mimicx::control {

/// ½ zᵀVz + vᵀz, V symmetric and stored whole.
struct ValueFunction {
  Eigen::MatrixXd V;
  Eigen::VectorXd v;
};

/// ½ (z, u)ᵀ H (z, u) + gᵀ (z, u); only the lower triangle of H is read.
struct StageCost {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

/// The control law of one frame: u = ū + α k + K (z − z̄).
struct Feedback {
  Eigen::MatrixXf K;  ///< [controls][state + memory]
  Eigen::VectorXf k;  ///< [controls]
};

/// What a step returns beside the law.
struct SweepResult {
  bool positive = false;  ///< Q_uu is positive definite; without it nothing else is valid
  double decrease = 0;    ///< of the cost that k promises: −q_uᵀk − ½ kᵀQ_uu k
};

/// F of a frame, in the layout of the derivatives.
using DynamicsRef = Eigen::Ref<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// x' = F (x, w, u) + gap, w' = the first `memory` entries of u. Refers to its matrices.
struct LinearDynamics {
  DynamicsRef F;               ///< [state][state + memory + controls]
  const Eigen::VectorXd& gap;  ///< [state], or empty: none
  int memory = 0;              ///< entries of w
};

/// Buffers of a sweep; their contents do not matter.
template <class Real>
struct RiccatiScratch {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix F, V, VF, FVF, root_inverse, Y, YtY, K;
};

/// One frame backwards.
/// @param regularisation  added to the diagonal of Q_uu: the price of moving u away from where it is
/// @param cost  of this frame; destroyed: becomes Q
/// @param value  of the next state in, of this one out
template <class Real>
SweepResult riccati_step(const LinearDynamics& dynamics, double regularisation, StageCost& cost,
                         ValueFunction& value, Feedback& law, RiccatiScratch<Real>& scratch);

}  // namespace mimicx::control
