/// Non-negative least squares.
///
/// Finds the forces x ≥ 0 along the columns of A that come closest to b: a wrench of six numbers, or a wrench
/// and torques. A small weight ε on the forces makes them unique:
///     minimise ½‖A x − b‖² + ½ε‖x‖²  over x ≥ 0.
/// Its conditions (Karush, Kuhn, Tucker) say x = max(0, Aᵀr)/ε with r = b − A x. So only r has to be found,
/// for any number of columns. It minimises
///     φ(r) = ½‖r‖² − bᵀr + ‖max(0, Aᵀr)‖²/2ε
/// φ is strictly convex and quadratic between the planes aᵢᵀr = 0; Newton steps with an exact line search
/// over these pieces reach its minimum in finitely many steps (D. P. Bertsekas, "Nonlinear Programming"
/// (2016), §3.4 for the duality; the pieces as in O. L. Mangasarian, "A finite Newton method for
/// classification", Optim. Methods Softw. 17 (2002)). Lawson and Hanson's active-set method finds the same x,
/// one column after the other.
#pragma once

#include "core/so3.h"

namespace mimicx::audit {

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// @param small  ε > 0, in parts of ‖aᵢ‖² ≈ 1
/// @return x, one per column; empty for a matrix without columns
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double small);

}  // namespace mimicx::audit
