/// Decompositions of matrices whose size is known at run time.
///
/// Eigen's own templates do the work. They take seconds to compile, so they are compiled here, once.
#pragma once

#include <Eigen/Core>

namespace mimicx {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< one per column, orthonormal
};

/// @param A  symmetric; its lower triangle is read
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);

/// x with A x = b, by LDLᵀ.
/// @param A  symmetric, positive or negative semidefinite
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A⁻¹, by LDLᵀ.
/// @param A  symmetric, positive or negative definite
Eigen::MatrixXd inverse_symmetric(const Eigen::MatrixXd& A);

}  // namespace mimicx
