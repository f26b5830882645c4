#include "control/riccati.h"

#include <Eigen/Cholesky>

namespace mimicx::control {
namespace {

/// Adds ½ |F (z, u) + gap|²_V and what falls on w' = u to the cost of the frame.
void add_value_of_next(const ValueFunction& next, const Eigen::VectorXd& gap, int memory, StageCost& Q,
                       RiccatiScratch& s) {
  const auto state = s.F.rows();
  const auto z = state + memory;
  Eigen::VectorXd v = next.v;
  if (gap.size() > 0) v.noalias() += next.V.leftCols(state) * gap;
  s.VF.noalias() = next.V.leftCols(state) * s.F;  // rows of x' and of w'
  Q.H.triangularView<Eigen::Lower>() += s.F.transpose() * s.VF.topRows(state);
  Q.g.noalias() += s.F.transpose() * v.head(state);
  if (memory == 0) return;
  const auto of_w = s.VF.bottomRows(memory);
  Q.H.middleRows(z, memory) += of_w;
  Q.H.block(z, z, Q.H.rows() - z, memory) += of_w.rightCols(Q.H.rows() - z).transpose();
  Q.H.block(z, z, memory, memory) += next.V.bottomRightCorner(memory, memory);
  Q.g.segment(z, memory) += v.tail(memory);
}

}  // namespace

SweepResult riccati_step(
    const Eigen::Ref<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>& F,
    const Eigen::VectorXd& gap, int memory, double regularisation, StageCost& cost, ValueFunction& value,
    Feedback& law, RiccatiScratch& s) {
  const auto z = F.rows() + memory, controls = F.cols() - z;
  s.F = F.cast<double>();
  add_value_of_next(value, gap, memory, cost, s);
  cost.H.diagonal().tail(controls).array() += regularisation;
  const auto Quz = cost.H.block(z, 0, controls, z);
  const auto q_u = cost.g.tail(controls);
  const Eigen::LLT<Eigen::MatrixXd> root(cost.H.bottomRightCorner(controls, controls));
  SweepResult result;
  result.positive = root.info() == Eigen::Success;
  if (!result.positive) return result;
  s.root = root.matrixL().solve(Quz);  // L⁻¹ Q_uz
  s.k = root.matrixL().solve(q_u);     // L⁻¹ q_u
  result.gradient = q_u.cwiseAbs().maxCoeff();
  result.decrease = 0.5 * s.k.squaredNorm();
  value.V = cost.H.topLeftCorner(z, z);
  value.V.selfadjointView<Eigen::Lower>().rankUpdate(s.root.transpose(), -1.0);
  value.V.triangularView<Eigen::StrictlyUpper>() = value.V.transpose();
  value.v = cost.g.head(z);
  value.v.noalias() -= s.root.transpose() * s.k;
  s.K = s.root;
  root.matrixU().solveInPlace(s.K);
  root.matrixU().solveInPlace(s.k);
  law.K = -s.K.cast<float>();
  law.k = -s.k.cast<float>();
  return result;
}

}  // namespace mimicx::control
