#include "audit/non_negative_least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/decompositions.h"
#include "core/random.h"

namespace mimicx::audit {
namespace {

Matrix6X random_matrix(Random& random, int columns) {
  Matrix6X A(6, columns);
  for (Eigen::Index i = 0; i < A.size(); ++i) A.data()[i] = random.normal();
  return A;
}
Vector6d random_wrench(Random& random) {
  Vector6d b;
  for (int k = 0; k < 6; ++k) b[k] = 100.0 * random.normal();
  return b;
}

double cost(const Matrix6X& A, const Vector6d& b, double small, const Eigen::VectorXd& x) {
  return 0.5 * (A * x - b).squaredNorm() + 0.5 * small * x.squaredNorm();
}

/// The best of all 2ⁿ choices of columns that may push, each solved without bounds.
double best_by_enumeration(const Matrix6X& A, const Vector6d& b, double small) {
  const int n = static_cast<int>(A.cols());
  double best = 0.5 * b.squaredNorm();
  for (int set = 1; set < (1 << n); ++set) {
    std::vector<int> chosen;
    for (int i = 0; i < n; ++i)
      if ((set >> i & 1) != 0) chosen.push_back(i);
    const Eigen::MatrixXd columns = A(Eigen::all, chosen);
    Eigen::MatrixXd normal = columns.transpose() * columns;
    normal.diagonal().array() += small;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    x(chosen) = solve_symmetric(normal, columns.transpose() * b);
    if (x.minCoeff() >= -1e-9) best = std::min(best, cost(A, b, small, x.cwiseMax(0.0)));
  }
  return best;
}

/// Karush, Kuhn, Tucker: x ≥ 0, gradient ≥ 0, and one of both zero.
void expect_optimal(const Matrix6X& A, const Vector6d& b, double small, const Eigen::VectorXd& x) {
  ASSERT_EQ(x.size(), A.cols());
  const Eigen::VectorXd gradient = A.transpose() * (A * x - b) + small * x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    EXPECT_GE(x[i], 0.0);
    EXPECT_GE(gradient[i], -1e-7 * b.norm()) << i;
    EXPECT_LE(std::min(x[i], gradient[i]), 1e-7 * b.norm()) << i;
  }
}

TEST(NonNegative, MatchesExhaustiveSearchOverActiveSets) {
  Random random(1, {0x6e6e6c73});
  for (int trial = 0; trial < 60; ++trial) {
    const Matrix6X A = random_matrix(random, 1 + trial % 9);
    const Vector6d b = random_wrench(random);
    const double small = trial % 2 == 0 ? 1e-2 : 1e-6;
    const Eigen::VectorXd x = non_negative_least_squares(A, b, small);
    EXPECT_NEAR(cost(A, b, small, x), best_by_enumeration(A, b, small), 1e-6 * b.squaredNorm()) << trial;
  }
}

TEST(NonNegative, MeetsTheKktConditionsWithManyColumns) {
  Random random(2, {0x6e6e6c73});
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix6X A = random_matrix(random, 1 + 2 * trial);
    const Vector6d b = random_wrench(random);
    for (const double small : {1e-2, 1e-6})
      expect_optimal(A, b, small, non_negative_least_squares(A, b, small));
  }
}

/// Feet close together: columns that are nearly, or exactly, the same.
TEST(NonNegative, MeetsTheKktConditionsWithDependentColumns) {
  Random random(3, {0x6e6e6c73});
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix6X few = random_matrix(random, 3);
    Matrix6X A(6, 48);
    for (int i = 0; i < 48; ++i) {
      Vector6d column = few.col(i % 3);
      if (i % 2 == 1) column *= 1.0 + 1e-6 * random.normal();
      for (int k = 0; k < 6; ++k) A(k, i) = column[k];
    }
    const Vector6d b = random_wrench(random);
    expect_optimal(A, b, 1e-6, non_negative_least_squares(A, b, 1e-6));
  }
}

TEST(NonNegative, UselessColumnsStayZero) {
  Matrix6X A = Matrix6X::Zero(6, 2);
  A(5, 0) = A(5, 1) = 1.0;
  Vector6d b = Vector6d::Zero();
  b[5] = -3.0;
  EXPECT_EQ(non_negative_least_squares(A, b, 1e-6).norm(), 0.0);
  b[5] = 3.0;  // shared alike, because the forces are to be small
  const Eigen::VectorXd x = non_negative_least_squares(A, b, 1e-6);
  EXPECT_NEAR(x[0], 1.5, 1e-5);
  EXPECT_NEAR(x[1], 1.5, 1e-5);
  EXPECT_EQ(non_negative_least_squares(Matrix6X(6, 0), b, 1e-6).size(), 0);
}

}  // namespace
}  // namespace mimicx::audit
