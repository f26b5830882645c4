#include "fit/least_squares/bordered_band.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/decompositions.h"
#include "core/random.h"

namespace mimicx::fit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  MatrixXd m(rows, columns);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

/// A random symmetric positive definite system: R Rᵀ + 1 with R block lower triangular of bandwidth 2, and a
/// border whose Schur complement is safely positive.
struct Made {
  BorderedBand band;
  MatrixXd B;  ///< the border of all frames
  MatrixXd dense;
  VectorXd rhs;
};

/// The border as the solver asks for it.
Border border_of(const Made& made) {
  return [&made](int first, std::span<MatrixXd> rows) {
    const auto n = made.band.diagonal[0].rows();
    for (MatrixXd& frame : rows) frame = made.B.middleRows(n * first++, n);
  };
}

Made random_system(int frames, int n, int m, std::uint64_t seed) {
  Random random(seed, {});
  const int size = frames * n;
  MatrixXd R = MatrixXd::Zero(size, size);
  for (int t = 0; t < frames; ++t)
    for (int s = std::max(0, t - 2); s <= t; ++s) R.block(t * n, s * n, n, n) = random_matrix(random, n, n);
  Made made{
      BorderedBand(frames, n, m), {}, MatrixXd::Zero(size + m, size + m), random_matrix(random, size + m, 1)};
  MatrixXd& D = made.dense;
  D.topLeftCorner(size, size) = R * R.transpose() + MatrixXd::Identity(size, size);
  const MatrixXd B = made.B = random_matrix(random, size, m), extra = random_matrix(random, m, m);
  D.topRightCorner(size, m) = B;
  D.bottomLeftCorner(m, size) = B.transpose();
  D.bottomRightCorner(m, m) = B.transpose() * inverse_symmetric(D.topLeftCorner(size, size)) * B +
                              extra * extra.transpose() + MatrixXd::Identity(m, m);
  for (int t = 0; t < frames; ++t) {
    made.band.diagonal[t] = D.block(t * n, t * n, n, n);
    if (t + 1 < frames) made.band.next[t] = D.block((t + 1) * n, t * n, n, n);
    if (t + 2 < frames) made.band.second[t] = D.block((t + 2) * n, t * n, n, n);
    made.band.rhs[t] = made.rhs.segment(t * n, n);
  }
  made.band.corner = D.bottomRightCorner(m, m);
  made.band.rhs_border = made.rhs.tail(m);
  return made;
}

TEST(BorderedBand, MatchesTheDenseSolution) {
  for (int frames : {1, 2, 3, 4, 9}) {
    Made made = random_system(frames, 5, 3, static_cast<std::uint64_t>(frames));
    const VectorXd expected = solve_symmetric(made.dense, made.rhs);
    const BandSolution found = solve(made.band, border_of(made));
    for (int t = 0; t < frames; ++t)
      EXPECT_LT((found.x[t] - expected.segment(5 * t, 5)).norm(), 1e-8) << frames;
    EXPECT_LT((found.g - expected.tail(3)).norm(), 1e-8) << frames;
  }
}

/// A border of several chunks.
TEST(BorderedBand, ThreadsDoNotChangeTheSolution) {
  Made one = random_system(3, 4, 150, 7), four = random_system(3, 4, 150, 7);
  const BandSolution a = solve(one.band, border_of(one), 1), b = solve(four.band, border_of(four), 4);
  EXPECT_EQ(a.g, b.g);
  for (int t = 0; t < 3; ++t) EXPECT_EQ(a.x[t], b.x[t]) << t;
  EXPECT_LT((a.g - solve_symmetric(one.dense, one.rhs).tail(150)).norm(), 1e-6);
}

TEST(BorderedBand, DrawsHaveTheInverseMatrixAsCovariance) {
  Made made = random_system(4, 2, 2, 5);
  const MatrixXd expected = inverse_symmetric(made.dense);
  Random random(3, {});
  constexpr int kDraws = 40000;
  const SolutionWithDraws solved = solve(made.band, border_of(made), kDraws, random);
  MatrixXd found = MatrixXd::Zero(10, 10);
  for (const BandSolution& d : solved.draws) {
    VectorXd all(10);
    all << d.x[0], d.x[1], d.x[2], d.x[3], d.g;
    found += all * all.transpose() / kDraws;
  }
  const VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();  // entries as correlations
  EXPECT_LT((scale.asDiagonal() * (found - expected) * scale.asDiagonal()).cwiseAbs().maxCoeff(), 0.04);
}

TEST(BorderedBand, RejectsAnIndefiniteSystem) {
  Made band = random_system(3, 2, 1, 1);
  band.band.diagonal[1](0, 0) = -1.0;
  EXPECT_THROW(solve(band.band, border_of(band)), std::domain_error);
  Made corner = random_system(3, 2, 1, 1);
  corner.band.corner(0, 0) = -1.0;
  EXPECT_THROW(solve(corner.band, border_of(corner)), std::domain_error);
}

/// However long the clip, only a block of the border is there; several blocks are made twice.
TEST(BorderedBand, HoldsOnlyABlockOfTheBorderOfALongClip) {
  for (int frames : {100, 1100}) {
    BorderedBand band(frames, 1, 1);
    for (MatrixXd& d : band.diagonal) d(0, 0) = 2.0;
    band.corner(0, 0) = 4.0 * frames;
    int calls = 0;
    std::set<const MatrixXd*> places;
    const BandSolution found = solve(band, [&](int, std::span<MatrixXd> rows) {
      for (MatrixXd& frame : rows) {
        frame = MatrixXd::Ones(1, 1);
        places.insert(&frame);
        ++calls;
      }
    });
    EXPECT_EQ(calls, frames > 512 ? 2 * frames : frames);
    EXPECT_LE(places.size(), 1024u);  // of two passes
    EXPECT_EQ(found.g[0], 0.0);
  }
}

/// A long clip's border comes in blocks: what is found solves the equations.
TEST(BorderedBand, BlocksOfTheBorderDoNotChangeTheSolution) {
  for (int frames : {511, 512, 513, 1100}) {
    BorderedBand band(frames, 1, 1);
    for (int t = 0; t < frames; ++t) {
      band.diagonal[t](0, 0) = 2.0;
      band.rhs[t][0] = 1.0;
      if (t + 1 < frames) band.next[t](0, 0) = 0.5;
      if (t + 2 < frames) band.second[t](0, 0) = -0.25;
    }
    band.corner(0, 0) = 4.0 * frames;
    band.rhs_border[0] = 1.0;
    const BorderedBand given = band;
    const BandSolution found = solve(band, [](int first, std::span<MatrixXd> rows) {
      for (MatrixXd& frame : rows) frame = MatrixXd::Constant(1, 1, std::sin(0.1 * first++));
    });
    double of_border = given.corner(0, 0) * found.g[0] - 1.0;
    for (int t = 0; t < frames; ++t) {
      const auto x = [&](int at) { return at >= 0 && at < frames ? found.x[at][0] : 0.0; };
      const double b = std::sin(0.1 * t);
      of_border += b * x(t);
      EXPECT_NEAR(2.0 * x(t) + 0.5 * (x(t - 1) + x(t + 1)) - 0.25 * (x(t - 2) + x(t + 2)) + b * found.g[0],
                  1.0, 1e-12);
    }
    EXPECT_NEAR(of_border, 0.0, 1e-10);
  }
}

}  // namespace
}  // namespace mimicx::fit
