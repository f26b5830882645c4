/// Linear programs with few equations and many unknowns: the simplex method on a tableau.
///
///     minimise cᵀx  over  A x = b, x ≥ 0
///
/// The first phase finds a vertex of the feasible set; every minimum starts at the vertex where the last one
/// ended. The entering column is the first that improves and of equal rows the one of the smallest variable
/// leaves (R. G. Bland, "New finite pivoting rules for the simplex method", Math. Oper. Res. 2 (1977)), so
/// that no vertex repeats. Dependent equations are allowed.
#pragma once

#include <Eigen/Core>

#include "core/containers.h"

namespace mimicx::audit {

class LinearProgram {
 public:
  /// A and b scaled so that their entries are of the order of 1.
  LinearProgram(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

  /// Whether an x ≥ 0 with A x = b was found, up to 1e-6.
  bool feasible() const { return feasible_; }

  /// The x of the smallest cᵀx. @throws std::logic_error unless feasible, and if cᵀx has no bound
  Eigen::VectorXd minimum(const Eigen::VectorXd& c);

 private:
  /// Makes column j basic in place of the variable of row i.
  void pivot(Eigen::Index i, Eigen::Index j);
  /// Of the column that enters; −1: no row bounds it.
  Eigen::Index leaving_row(Eigen::Index j) const;
  void find_vertex();

  Eigen::MatrixXd rows_;      ///< [equations × (unknowns + 1)] in terms of the basis; the last column is x
  List<Eigen::Index> basis_;  ///< of each row; −1: no unknown yet
  bool feasible_ = false;
};

}  // namespace mimicx::audit
