// The backward sweep against the algebraic Riccati equation.
#include "control/riccati.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace mimicx::control {
namespace {

struct Regulator {
  Eigen::MatrixXd A, B, Q, R;
};

/// Sweeps back until nothing changes. @return P of the cost-to-go ½ xᵀPx; K of the last law in `gain`
Eigen::MatrixXd sweep(const Regulator& r, int steps, Eigen::MatrixXd& gain) {
  const auto n = r.A.rows(), m = r.B.cols();
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> F(n, n + m);
  F << r.A.cast<float>(), r.B.cast<float>();
  ValueFunction value{r.Q, Eigen::VectorXd::Zero(n)};
  Feedback law;
  RiccatiScratch<double> scratch;
  for (int k = 0; k < steps; ++k) {
    StageCost cost{Eigen::MatrixXd::Zero(n + m, n + m), Eigen::VectorXd::Zero(n + m)};
    cost.H.topLeftCorner(n, n) = r.Q;
    cost.H.bottomRightCorner(m, m) = r.R;
    EXPECT_TRUE(riccati_step(F, {}, 0, 0.0, cost, value, law, scratch).positive);
  }
  gain = law.K.cast<double>();
  return value.V;
}

/// P − (Q + AᵀPA − AᵀPB (R + BᵀPB)⁻¹ BᵀPA)
double riccati_residual(const Regulator& r, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd PB = P * r.B, S = r.R + r.B.transpose() * PB;
  const Eigen::MatrixXd next =
      r.Q + r.A.transpose() * P * r.A - r.A.transpose() * PB * S.inverse() * PB.transpose() * r.A;
  return (P - next).cwiseAbs().maxCoeff() / P.cwiseAbs().maxCoeff();
}

// dt, ½ and 1 are floats exactly. By hand (docs/control.md): with Q = diag(1, 0), R = r and dt → 0 the gains
// of the double integrator tend to (1/√r, √2 / r^¼); at dt = 1/64 they are within its order.
TEST(Riccati, DoubleIntegratorSolvesTheAlgebraicEquation) {
  const double dt = 1.0 / 64.0, r = 0.25;
  Regulator d;
  d.A = (Eigen::Matrix2d() << 1, dt, 0, 1).finished();
  d.B = Eigen::Vector2d(0.5 * dt * dt, dt);
  d.Q = Eigen::Vector2d(dt, 0).asDiagonal();
  d.R = Eigen::MatrixXd::Constant(1, 1, r * dt);
  Eigen::MatrixXd K;
  const Eigen::MatrixXd value = sweep(d, 3000, K);
  EXPECT_LT(riccati_residual(d, value), 1e-7);  // B is rounded to a float in the sweep
  EXPECT_NEAR(-K(0, 0), 1.0 / std::sqrt(r), 0.05);
  EXPECT_NEAR(-K(0, 1), std::sqrt(2.0) / std::pow(r, 0.25), 0.05);
}

// A pendulum held upright: unstable without control, stable with the sweep's.
TEST(Riccati, InvertedPendulumIsStabilised) {
  const double dt = 1.0 / 32.0, gravity = 8.0;
  Regulator p;
  p.A = (Eigen::Matrix2d() << 1, dt, gravity * dt, 1).finished();
  p.B = Eigen::Vector2d(0, dt);
  p.Q = Eigen::Vector2d(1, 0.125).asDiagonal();
  p.R = Eigen::MatrixXd::Constant(1, 1, 0.5);
  Eigen::MatrixXd K;
  const Eigen::MatrixXd value = sweep(p, 500, K);
  EXPECT_LT(riccati_residual(p, value), 1e-12);
  EXPECT_GT(p.A.eigenvalues().cwiseAbs().maxCoeff(), 1.0);
  EXPECT_LT((p.A + p.B * K).eigenvalues().cwiseAbs().maxCoeff(), 1.0);
}

// A problem of two steps with memory and a gap, against one solve of its normal equations.
TEST(Riccati, MemoryAndGapsAreThoseOfTheWholeProblem) {
  constexpr int n = 3, w = 2, m = 3;
  srand(5);
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> F[2];
  Eigen::VectorXd gap[2];
  StageCost stage[2];
  const auto positive = [](int size) {
    const Eigen::MatrixXd X = Eigen::MatrixXd::Random(size, size);
    return Eigen::MatrixXd(X * X.transpose() + Eigen::MatrixXd::Identity(size, size));
  };
  for (int t = 0; t < 2; ++t) {
    F[t] = Eigen::MatrixXf::Random(n, n + w + m);
    gap[t] = Eigen::VectorXd::Random(n);
    stage[t] = {positive(n + w + m), Eigen::VectorXd::Random(n + w + m)};
  }
  const ValueFunction last{positive(n + w), Eigen::VectorXd::Random(n + w)};
  // Unknowns y = (u_0, u_1); z_0 = 0. (z_t, u_t) = M_t y + c_t.
  Eigen::MatrixXd z = Eigen::MatrixXd::Zero(n + w, 2 * m), H = Eigen::MatrixXd::Zero(2 * m, 2 * m);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(n + w), g = Eigen::VectorXd::Zero(2 * m);
  const auto add = [&](const Eigen::MatrixXd& M, const Eigen::VectorXd& o, const Eigen::MatrixXd& cost,
                       const Eigen::VectorXd& linear) {
    H += M.transpose() * cost * M;
    g += M.transpose() * (cost * o + linear);
  };
  for (int t = 0; t < 2; ++t) {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + w + m, 2 * m);
    Eigen::VectorXd o = Eigen::VectorXd::Zero(n + w + m);
    M.topRows(n + w) = z;
    M.block(n + w, m * t, m, m).setIdentity();
    o.head(n + w) = c;
    add(M, o, stage[t].H, stage[t].g);
    z.topRows(n) = F[t].cast<double>() * M;
    c.head(n) = F[t].cast<double>() * o + gap[t];
    z.bottomRows(w) = M.middleRows(n + w, w);
    c.tail(w).setZero();
  }
  add(z, c, last.V, last.v);
  const Eigen::VectorXd expected = -H.ldlt().solve(g);

  ValueFunction value = last;
  Feedback law[2];
  RiccatiScratch<double> scratch;
  for (int t = 1; t >= 0; --t)
    ASSERT_TRUE(riccati_step(F[t], gap[t], w, 0.0, stage[t], value, law[t], scratch).positive);
  const Eigen::VectorXd u0 = law[0].k.cast<double>();
  Eigen::VectorXd first(n + w + m), z1(n + w);
  first << Eigen::VectorXd::Zero(n + w), u0;
  z1 << F[0].cast<double>() * first + gap[0], u0.head(w);
  const Eigen::VectorXd u1 = law[1].k.cast<double>() + law[1].K.cast<double>() * z1;
  EXPECT_LT((u0 - expected.head(m)).norm(), 1e-5 * expected.norm());
  EXPECT_LT((u1 - expected.tail(m)).norm(), 1e-5 * expected.norm());
}

TEST(Riccati, SaysWhereThereIsNoMinimum) {
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> F = Eigen::MatrixXf::Zero(1, 2);
  StageCost cost{Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Zero(2)};
  cost.H(1, 1) = -1.0;
  ValueFunction value{Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1)};
  Feedback law;
  RiccatiScratch<double> scratch;
  EXPECT_FALSE(riccati_step(F, {}, 0, 0.0, cost, value, law, scratch).positive);
}

}  // namespace
}  // namespace mimicx::control
