// The backward sweep against the algebraic Riccati equation.
#include "control/riccati.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/decompositions.h"

namespace mimicx::control {
namespace {

struct Regulator {
  Eigen::MatrixXd A, B, Q, R;
};

// Products with few types: Eigen's long expressions take half a minute to compile.
Eigen::MatrixXd product_of(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }
Eigen::MatrixXd transposed(const Eigen::MatrixXd& a) { return a.transpose(); }
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a) { return a.inverse(); }
/// Of a 2 × 2 matrix: the larger root of λ² − λ tr A + det A.
double spectral_radius(const Eigen::Matrix2d& a) {
  const double half = 0.5 * a.trace(), square = half * half - a.determinant();
  return square < 0.0 ? std::sqrt(a.determinant()) : std::abs(half) + std::sqrt(square);
}

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
    EXPECT_TRUE(riccati_step({F, {}, 0}, 0.0, cost, value, law, scratch).positive);
  }
  gain = law.K.cast<double>();
  return value.V;
}

/// P − (Q + AᵀPA − AᵀPB (R + BᵀPB)⁻¹ BᵀPA)
double riccati_residual(const Regulator& r, const Eigen::MatrixXd& P) {
  const Eigen::MatrixXd PB = product_of(P, r.B), S = r.R + product_of(transposed(r.B), PB),
                        At = transposed(r.A), BtPA = product_of(transposed(PB), r.A);
  const Eigen::MatrixXd next =
      r.Q + product_of(At, product_of(P, r.A)) - product_of(transposed(BtPA), product_of(inverse(S), BtPA));
  return (P - next).cwiseAbs().maxCoeff() / P.cwiseAbs().maxCoeff();
}

/// The solution of the algebraic Riccati equation by another way, the structure-preserving doubling
/// algorithm: step k is the cost of 2ᵏ frames (E. K.-W. Chu, H.-Y. Fan, W.-W. Lin, C.-S. Wang, Int. J.
/// Control 77 (2004)).
Eigen::MatrixXd algebraic_solution(const Regulator& r) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(r.A.rows(), r.A.rows());
  Eigen::MatrixXd A = r.A, G = product_of(r.B, product_of(inverse(r.R), transposed(r.B))), H = r.Q;
  for (int k = 0; k < 30; ++k) {
    const Eigen::MatrixXd W = inverse(one + product_of(G, H)), AW = product_of(A, W), At = transposed(A);
    H += product_of(At, product_of(H, product_of(W, A)));
    G += product_of(AW, product_of(G, At));
    A = product_of(AW, A);
  }
  return H;
}

/// A mass on a line, pushed for `dt` at a time; its place costs 1 per second, a push r per second.
Regulator double_integrator(double dt, double r) {
  Regulator d;
  d.A = (Eigen::Matrix2d() << 1, dt, 0, 1).finished();
  d.B = Eigen::Vector2d(0.5 * dt * dt, dt);
  d.Q = Eigen::Vector2d(dt, 0).asDiagonal();
  d.R = Eigen::MatrixXd::Constant(1, 1, r * dt);
  return d;
}

const double kGolden = 0.5 * (1.0 + std::sqrt(5.0));

// The numbers of docs/control.md §1, "One number": V goes through quotients of Fibonacci numbers.
TEST(Riccati, ScalarIntegratorsValueIsTheGoldenRatio) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  const Regulator s{one, one, one, one};
  Eigen::MatrixXd K;
  const double quotients[] = {1.0, 3.0 / 2.0, 8.0 / 5.0, 21.0 / 13.0};
  for (int steps = 0; steps < 4; ++steps) EXPECT_NEAR(sweep(s, steps, K)(0, 0), quotients[steps], 1e-15);
  const Eigen::MatrixXd value = sweep(s, 40, K);
  EXPECT_NEAR(value(0, 0), kGolden, 1e-15);
  EXPECT_NEAR(K(0, 0), -1.0 / kGolden, 1e-7);  // laws are floats
  EXPECT_NEAR(1.0 + K(0, 0), std::pow(kGolden, -2), 1e-7);
  EXPECT_NEAR(1.0 + K(0, 0), 0.382, 5e-4);
  EXPECT_NEAR(algebraic_solution(s)(0, 0), kGolden, 1e-14);
}

// The numbers of docs/control.md §1, "By hand".
TEST(Riccati, DoubleIntegratorMatchesTheHandCalculation) {
  const Regulator d = double_integrator(1.0, 0.25);
  const auto expect_near = [](const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected, double within) {
    EXPECT_LT((actual - expected).cwiseAbs().maxCoeff(), within) << actual << "\nand not\n" << expected;
  };
  expect_near(d.R + d.B.transpose() * d.Q * d.B, Eigen::MatrixXd::Constant(1, 1, 0.5), 1e-15);
  expect_near(d.B.transpose() * d.Q * d.A, Eigen::RowVector2d(0.5, 0.5), 1e-15);
  expect_near(d.A.transpose() * d.Q * d.A, Eigen::Matrix2d::Ones(), 1e-15);
  Eigen::MatrixXd K;
  expect_near(sweep(d, 1, K), (Eigen::Matrix2d() << 1.5, 0.5, 0.5, 0.5).finished(), 1e-15);
  expect_near(K, Eigen::RowVector2d(-1.0, -1.0), 1e-7);
  expect_near(sweep(d, 2, K), (Eigen::Matrix2d() << 20, 6, 6, 7).finished() / 13.0, 1e-15);
  expect_near(K, -Eigen::RowVector2d(10, 16) / 13.0, 1e-7);

  const double root5 = std::sqrt(5.0), g = kGolden;
  const Eigen::Matrix2d V = (Eigen::Matrix2d() << g, 0.5, 0.5, 0.25 * root5).finished();
  expect_near(d.R + d.B.transpose() * V * d.B, Eigen::MatrixXd::Constant(1, 1, 0.25 * std::pow(g, 4)), 1e-14);
  expect_near(d.B.transpose() * V * d.A, 0.5 * Eigen::RowVector2d(g * g, g * g * g), 1e-14);
  const Eigen::Matrix2d AtVA = (Eigen::Matrix2d() << g, g + 0.5, g + 0.5, g * g + 0.25 * root5).finished();
  expect_near(d.A.transpose() * V * d.A, AtVA, 1e-14);
  const Eigen::RowVector2d law(-2.0 / (g * g), -2.0 / g);
  const Eigen::Matrix2d taken = (Eigen::Matrix2d() << 1, g, g, g * g).finished();
  expect_near(d.A.transpose() * V * d.B * law, -taken, 1e-14);
  expect_near(d.Q + AtVA - taken, V, 1e-14);
  EXPECT_LT(riccati_residual(d, V), 1e-15);
  expect_near(algebraic_solution(d), V, 1e-13);
  expect_near(sweep(d, 4, K), V, 0.01);
  expect_near(sweep(d, 40, K), V, 1e-14);
  expect_near(K, law, 1e-7);
  expect_near(law, Eigen::RowVector2d(-0.764, -1.236), 5e-4);

  // A sixth of a turn and a shrinking by φ² per frame: three frames turn every state round.
  const Eigen::Matrix2d closed = d.A + d.B * law;
  EXPECT_NEAR(closed.determinant(), std::pow(g, -4), 1e-14);
  EXPECT_NEAR(closed.trace(), std::pow(g, -2), 1e-14);
  expect_near(closed * closed * closed, -std::pow(g, -6) * Eigen::Matrix2d::Identity(), 1e-14);
  Eigen::Vector2d x(1, 0);
  double cost = 0.0;
  const double places[] = {1.0, 0.618, 0.090, -0.056, -0.034};
  for (int t = 0; t < 60; ++t) {
    if (t < 5) {
      EXPECT_NEAR(x[0], places[t], 5e-4) << t;
    }
    const double u = law * x;
    cost += x[0] * x[0] + 0.25 * u * u;
    x = d.A * x + d.B * u;
  }
  EXPECT_NEAR(cost, g, 1e-12);
}

// dt, ½ and 1 are floats exactly. As dt → 0 the values and gains tend to those of docs/control.md §1, (3), in
// proportion to dt.
TEST(Riccati, DoubleIntegratorSolvesTheAlgebraicEquation) {
  const auto continuous = [](double r) {
    const double b = std::sqrt(r), c = std::sqrt(2.0 * r * b);
    return Eigen::Matrix2d((Eigen::Matrix2d() << b * c / r, b, b, c).finished());
  };
  for (const double r : {0.25, 4.0}) {
    double off[2];
    for (int half = 0; half < 2; ++half) {
      const Regulator d = double_integrator(half == 0 ? 1.0 / 64.0 : 1.0 / 128.0, r);
      Eigen::MatrixXd K;
      const Eigen::MatrixXd value = sweep(d, 8000, K);
      EXPECT_LT(riccati_residual(d, value), 1e-12);
      EXPECT_LT((value - algebraic_solution(d)).norm(), 1e-9 * value.norm());
      EXPECT_LT((value - continuous(r)).cwiseAbs().maxCoeff(), 0.01);
      EXPECT_NEAR(-K(0, 0), 1.0 / std::sqrt(r), 0.05);
      EXPECT_NEAR(-K(0, 1), std::sqrt(2.0) / std::pow(r, 0.25), 0.05);
      off[half] = -K(0, 0) - 1.0 / std::sqrt(r);
    }
    EXPECT_NEAR(off[0] / off[1], 2.0, 0.05);
  }
  EXPECT_LT((continuous(0.25) - (Eigen::Matrix2d() << 1, 0.5, 0.5, 0.5).finished()).norm(), 1e-15);
}

// e^(−t) (cos t + sin t), which the frames of 1/64 s follow; it costs 1 and is lowest, −e^(−π), at t = π.
TEST(Riccati, DoubleIntegratorFollowsTheClosedForm) {
  const double dt = 1.0 / 64.0;
  const Regulator d = double_integrator(dt, 0.25);
  Eigen::MatrixXd K;
  sweep(d, 3000, K);
  Eigen::Vector2d x(1, 0);
  double cost = 0.0, lowest = 0.0, when = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double t = k * dt, u = (K * x)[0];
    EXPECT_NEAR(x[0], std::exp(-t) * (std::cos(t) + std::sin(t)), 0.01);
    EXPECT_NEAR(x[1], -2.0 * std::exp(-t) * std::sin(t), 0.01);
    if (x[0] < lowest) lowest = x[0], when = t;
    cost += dt * (x[0] * x[0] + 0.25 * u * u);
    x = d.A * x + d.B * u;
  }
  EXPECT_NEAR(cost, 1.0, 0.01);
  EXPECT_NEAR(lowest, -std::exp(-std::acos(-1.0)), 1e-4);
  EXPECT_NEAR(lowest, -0.0432, 5e-5);
  EXPECT_NEAR(when, std::acos(-1.0), 0.02);
}

// A pendulum held upright: unstable without control, stable with the sweep's.
TEST(Riccati, InvertedPendulumSolvesTheAlgebraicEquationAndIsStable) {
  const double dt = 1.0 / 32.0, gravity = 8.0;
  Regulator p;
  p.A = (Eigen::Matrix2d() << 1, dt, gravity * dt, 1).finished();
  p.B = Eigen::Vector2d(0, dt);
  p.Q = Eigen::Vector2d(1, 0.125).asDiagonal();
  p.R = Eigen::MatrixXd::Constant(1, 1, 0.5);
  Eigen::MatrixXd K;
  const Eigen::MatrixXd value = sweep(p, 500, K);
  EXPECT_LT(riccati_residual(p, value), 1e-12);
  EXPECT_LT((value - algebraic_solution(p)).norm(), 1e-10 * value.norm());
  EXPECT_GT(spectral_radius(p.A), 1.0);
  EXPECT_LT(spectral_radius(p.A + product_of(p.B, K)), 1.0);
}

// A problem of two steps with memory and a gap, against the solution of its normal equations.
TEST(Riccati, MemoryAndGapsMatchTheNormalEquations) {
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
    const Eigen::MatrixXd Mt = transposed(M);
    H += product_of(Mt, product_of(cost, M));
    g += product_of(Mt, product_of(cost, o) + linear);
  };
  for (int t = 0; t < 2; ++t) {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + w + m, 2 * m);
    Eigen::VectorXd o = Eigen::VectorXd::Zero(n + w + m);
    M.topRows(n + w) = z;
    M.block(n + w, m * t, m, m).setIdentity();
    o.head(n + w) = c;
    add(M, o, stage[t].H, stage[t].g);
    const Eigen::MatrixXd step = F[t].cast<double>();
    z.topRows(n) = product_of(step, M);
    c.head(n) = product_of(step, o) + gap[t];
    z.bottomRows(w) = M.middleRows(n + w, w);
    c.tail(w).setZero();
  }
  add(z, c, last.V, last.v);
  const Eigen::VectorXd expected = -solve_symmetric(H, g);

  ValueFunction value = last;
  Feedback law[2];
  RiccatiScratch<double> scratch;
  for (int t = 1; t >= 0; --t)
    ASSERT_TRUE(riccati_step({F[t], gap[t], w}, 0.0, stage[t], value, law[t], scratch).positive);
  const Eigen::VectorXd u0 = law[0].k.cast<double>();
  Eigen::VectorXd first(n + w + m), z1(n + w);
  first << Eigen::VectorXd::Zero(n + w), u0;
  z1 << F[0].cast<double>() * first + gap[0], u0.head(w);
  const Eigen::VectorXd u1 = law[1].k.cast<double>() + law[1].K.cast<double>() * z1;
  EXPECT_LT((u0 - expected.head(m)).norm(), 1e-5 * expected.norm());
  EXPECT_LT((u1 - expected.tail(m)).norm(), 1e-5 * expected.norm());
}

TEST(Riccati, ReportsAMissingMinimum) {
  const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> F = Eigen::MatrixXf::Zero(1, 2);
  StageCost cost{Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd::Zero(2)};
  cost.H(1, 1) = -1.0;
  ValueFunction value{Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Zero(1)};
  Feedback law;
  RiccatiScratch<double> scratch;
  EXPECT_FALSE(riccati_step({F, {}, 0}, 0.0, cost, value, law, scratch).positive);
}

}  // namespace
}  // namespace mimicx::control
