/// One backward step of the linear-quadratic regulator: from the value function of the next state to the
/// optimal control law and the value function of this state.
///
/// The state includes part of the previous control (differences.h): z = (x, w) with
///     x' = F (x, w, u) + gap,      w' = the first entries of u,
/// and the cost of a frame is ½ (z, u)ᵀ H (z, u) + gᵀ (z, u). With the value of the next state
/// ½ z'ᵀ V z' + vᵀ z', the sum of both is a quadratic function Q of (z, u), least at
///     u = k + K z,      K = −Q_uu⁻¹ Q_uz,      k = −Q_uu⁻¹ q_u,
/// and V ← Q_zz − Q_zu Q_uu⁻¹ Q_uz is the value of this frame. With `memory` 0 this is the textbook regulator
/// (docs/control.md §1, (2)). Source: Tassa, Erez, Todorov, "Synthesis and Stabilization
/// of Complex Behaviors through Online Trajectory Optimization" (2012), eqs. (5), (6); gaps: Mastalli et al.,
/// "Crocoddyl" (2020), §IV-B.
///
/// Matrix products take nearly all of the time. Their scalar is `Real`; gradients, Q_uu and its Cholesky
/// factor are always in double. Planning uses float, which halves the time at equal quality
/// (docs/control.md).
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
  double decrease = 0;    ///< decrease of the cost predicted for k: −q_uᵀk − ½ kᵀQ_uu k
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
/// @param regularisation  added to the diagonal of Q_uu: weight on changes of u
/// @param cost  in: of this frame; out: Q
/// @param value  in: of the next state; out: of this state
template <class Real>
SweepResult riccati_step(const LinearDynamics& dynamics, double regularisation, StageCost& cost,
                         ValueFunction& value, Feedback& law, RiccatiScratch<Real>& scratch);

}  // namespace mimicx::control
