/// Inverse and forward dynamics of a `BookModel`, each by another algorithm of the book.
///
/// `qdd` and `tau` have the 61 entries of book_model.h. The acceleration of the pelvis in qdd is the
/// *spatial* one in the pelvis frame, gravity not subtracted.
#pragma once

#include "oracles/book_model.h"

namespace mimicx::test {

/// Recursive Newton–Euler: the generalised forces that produce qdd. Entries 0..5 are the spatial force that
/// would have to act on the pelvis. Armature included.                       RBDA table 5.1 with eq. 5.20
Eigen::VectorXd book_inverse_dynamics(const BookModel& model, const BookPosition& q,
                                      const Eigen::VectorXd& qd, const Eigen::VectorXd& qdd,
                                      const BookForces& external);

/// Composite-rigid-body algorithm: H with the armature on its diagonal.      RBDA table 6.2
Eigen::MatrixXd book_mass_matrix(const BookModel& model, const BookPosition& q);

/// H⁻¹(τ − C) by Cholesky, with C from Newton–Euler at q̈ = 0.
Eigen::VectorXd book_forward_dynamics_dense(const BookModel& model, const BookPosition& q,
                                            const Eigen::VectorXd& qd, const Eigen::VectorXd& tau,
                                            const BookForces& external);

/// Articulated-body algorithm with dense 6×6 matrices.                       RBDA tables 7.1 and 9.4
Eigen::VectorXd book_forward_dynamics_aba(const BookModel& model, const BookPosition& q,
                                          const Eigen::VectorXd& qd, const Eigen::VectorXd& tau,
                                          const BookForces& external);

}  // namespace mimicx::test
