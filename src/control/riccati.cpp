#include "control/riccati.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <type_traits>

namespace mimicx::control {
namespace {

/// Adds the lower triangle of `term` to that of `sum`, column by column: Eigen's own sum goes entry by entry.
template <class Real>
void add_lower(const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>& term, Eigen::MatrixXd& sum) {
  const auto n = term.cols();
  for (Eigen::Index j = 0; j < n; ++j)
    sum.col(j).tail(n - j) += term.col(j).tail(n - j).template cast<double>();
}

/// Copies the lower triangle onto the upper one in squares of 16: whole columns would miss the cache.
void mirror(Eigen::MatrixXd& V) {
  constexpr Eigen::Index kSquare = 16;
  const auto n = V.cols();
  for (Eigen::Index j = 0; j < n; j += kSquare) {
    const auto columns = std::min(kSquare, n - j), below = j + columns;
    auto square = V.block(j, j, columns, columns);
    square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
    for (Eigen::Index i = below; i < n; i += kSquare) {
      const auto rows = std::min(kSquare, n - i);
      V.block(j, i, columns, rows) = V.block(i, j, rows, columns).transpose();
    }
  }
}

/// F in the scalar of the products; no copy if it is in that scalar already.
template <class Real>
const auto& in_scalar(const DynamicsRef& F, RiccatiScratch<Real>& s) {
  if constexpr (std::is_same_v<Real, float>)
    return F;
  else
    return s.F = F.cast<Real>();
}

/// Adds the value of the next state, ½ (x', w')ᵀ V (x', w') + …, to the cost of the frame.
template <class Real>
void add_value_of_next(const ValueFunction& next, const LinearDynamics& dynamics, StageCost& Q,
                       RiccatiScratch<Real>& s) {
  const auto& F = in_scalar<Real>(dynamics.F, s);
  const int memory = dynamics.memory;
  const auto state = F.rows(), z = state + memory, all = F.cols();
  Eigen::VectorXd v = next.v;
  if (dynamics.gap.size() > 0) v.noalias() += next.V.leftCols(state) * dynamics.gap;
  for (Eigen::Index row = 0; row < state; ++row)
    Q.g.noalias() += v[row] * dynamics.F.row(row).transpose().template cast<double>();
  s.V = next.V.leftCols(state).template cast<Real>();
  s.VF.noalias() = s.V * F;  // rows of x' and of w'
  s.FVF.resize(all, all);
  s.FVF.template triangularView<Eigen::Lower>() = F.transpose() * s.VF.topRows(state);
  add_lower<Real>(s.FVF, Q.H);
  if (memory == 0) return;
  // w' is u itself: its rows of VF fall onto the rows of u, and by symmetry onto the columns;
  // only the lower triangle counts.
  const auto of_w = s.VF.bottomRows(memory);
  Q.H.block(z, 0, memory, z + memory) += of_w.leftCols(z + memory).template cast<double>();
  Q.H.block(z, z, all - z, memory) += of_w.rightCols(all - z).transpose().template cast<double>();
  Q.H.block(z, z, memory, memory) += next.V.bottomRightCorner(memory, memory);
  Q.g.segment(z, memory) += v.tail(memory);
}

}  // namespace

template <class Real>
SweepResult riccati_step(const LinearDynamics& dynamics, double regularisation, StageCost& cost,
                         ValueFunction& value, Feedback& law, RiccatiScratch<Real>& s) {
  using Matrix = typename RiccatiScratch<Real>::Matrix;
  const auto z = dynamics.F.rows() + dynamics.memory, controls = dynamics.F.cols() - z;
  add_value_of_next(value, dynamics, cost, s);
  cost.H.diagonal().tail(controls).array() += regularisation;
  const Eigen::LLT<Eigen::MatrixXd> root(cost.H.bottomRightCorner(controls, controls));
  SweepResult result;
  result.positive = root.info() == Eigen::Success;
  if (!result.positive) return result;
  // With Q_uu = L Lᵀ and Y = L⁻¹ Q_uz, y = L⁻¹ q_u:  K = −L⁻ᵀ Y, k = −L⁻ᵀ y, V = Q_zz − Yᵀ Y, v = q_z − Yᵀ y.
  const Eigen::MatrixXd inverse = root.matrixL().solve(Eigen::MatrixXd::Identity(controls, controls));
  const Eigen::VectorXd y = inverse * cost.g.tail(controls);
  s.root_inverse = inverse.cast<Real>();
  const Matrix Quz = cost.H.block(z, 0, controls, z).template cast<Real>();
  s.Y.noalias() = s.root_inverse * Quz;
  s.K.noalias() = s.root_inverse.transpose() * s.Y;
  law.K = -s.K.template cast<float>();
  law.k = (-(inverse.transpose() * y)).cast<float>();
  result.decrease = 0.5 * y.squaredNorm();
  s.YtY.resize(z, z);
  s.YtY.template triangularView<Eigen::Lower>().setZero();
  s.YtY.template selfadjointView<Eigen::Lower>().rankUpdate(s.Y.transpose(), Real(-1));
  value.V.resize(z, z);
  for (Eigen::Index j = 0; j < z; ++j)
    value.V.col(j).tail(z - j) =
        cost.H.col(j).segment(j, z - j) + s.YtY.col(j).tail(z - j).template cast<double>();
  mirror(value.V);
  value.v = cost.g.head(z);
  value.v.noalias() -= s.Y.transpose().template cast<double>() * y;
  return result;
}

template SweepResult riccati_step(const LinearDynamics&, double, StageCost&, ValueFunction&, Feedback&,
                                  RiccatiScratch<float>&);
template SweepResult riccati_step(const LinearDynamics&, double, StageCost&, ValueFunction&, Feedback&,
                                  RiccatiScratch<double>&);

}  // namespace mimicx::control
