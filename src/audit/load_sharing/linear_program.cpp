#include "audit/load_sharing/linear_program.h"

#include <stdexcept>

namespace mimicx::audit {
namespace {

constexpr double kZero = 1e-9;      ///< below it a coefficient or a slope is rounding
constexpr double kRest = 1e-6;      ///< below it equations are met
constexpr int kMostPivots = 10000;  ///< observed: under 200; bounds the loops even if rounding causes a cycle

}  // namespace

LinearProgram::LinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b)
    : rows_(A.rows(), A.cols() + 1), basis_(A.rows(), -1) {
  rows_ << A, b;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (b[i] < 0.0) rows_.row(i) *= -1.0;
  find_vertex();
}

void LinearProgram::pivot(Eigen::Index i, Eigen::Index j) {
  rows_.row(i) /= rows_(i, j);
  for (Eigen::Index k = 0; k < rows_.rows(); ++k)
    if (k != i) rows_.row(k) -= rows_(k, j) * rows_.row(i).eval();
  rows_.col(rows_.cols() - 1) = rows_.col(rows_.cols() - 1).cwiseMax(0.0);  // rounding alone is below 0
  basis_[i] = j;
}

Eigen::Index LinearProgram::leaving_row(Eigen::Index j) const {
  const Eigen::Index last = rows_.cols() - 1;
  Eigen::Index leaving = -1;
  for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
    if (!(rows_(i, j) > kZero)) continue;
    if (leaving < 0) {
      leaving = i;
      continue;
    }
    const double here = rows_(i, last) * rows_(leaving, j), best = rows_(leaving, last) * rows_(i, j);
    if (here < best || (here == best && basis_[i] < basis_[leaving])) leaving = i;
  }
  return leaving;
}

void LinearProgram::find_vertex() {
  const Eigen::Index unknowns = rows_.cols() - 1;
  // What the rows without an unknown still lack is their sum; it falls until no column lowers it.
  const auto lacking = [&](Eigen::Index j) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < rows_.rows(); ++i)
      if (basis_[i] < 0) sum += rows_(i, j);
    return sum;
  };
  int pivots = 0;
  for (Eigen::Index j = 0; j < unknowns && pivots < kMostPivots;)
    if (lacking(j) > kZero && leaving_row(j) >= 0) {
      ++pivots;
      pivot(leaving_row(j), j);
      j = 0;
    } else {
      ++j;
    }
  feasible_ = lacking(unknowns) <= kRest;
  for (Eigen::Index i = 0; i < rows_.rows(); ++i) {
    if (basis_[i] >= 0) continue;
    Eigen::Index largest = 0;
    if (rows_.row(i).head(unknowns).cwiseAbs().maxCoeff(&largest) > kZero) pivot(i, largest);
  }
}

Eigen::VectorXd LinearProgram::minimum(const Eigen::VectorXd& c) {
  if (!feasible_) throw std::logic_error("LinearProgram: nothing is feasible");
  const Eigen::Index unknowns = rows_.cols() - 1;
  const auto slope = [&](Eigen::Index j) {
    double s = c[j];
    for (Eigen::Index i = 0; i < rows_.rows(); ++i)
      if (basis_[i] >= 0) s -= c[basis_[i]] * rows_(i, j);
    return s;
  };
  int pivots = 0;
  for (Eigen::Index j = 0; j < unknowns && pivots < kMostPivots;)
    if (slope(j) < -kZero) {
      const Eigen::Index i = leaving_row(j);
      if (i < 0) throw std::logic_error("LinearProgram: the objective has no bound");
      ++pivots;
      pivot(i, j);
      j = 0;
    } else {
      ++j;
    }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns);
  for (Eigen::Index i = 0; i < rows_.rows(); ++i)
    if (basis_[i] >= 0) x[basis_[i]] = rows_(i, unknowns);
  return x;
}

}  // namespace mimicx::audit
