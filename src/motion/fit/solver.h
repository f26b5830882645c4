/// The linear system of the keypoint fit, docs/method.md, "Keypoint fit", (9): a symmetric positive definite
/// block band with a border.
///
///   ⎡ A   B ⎤ ⎡ x ⎤   ⎡ a ⎤     A: frames × frames blocks of n × n, block bandwidth 2 (neighbours and
///   ⎣ Bᵀ  C ⎦ ⎣ g ⎦ = ⎣ b ⎦        the frames after them); C: m × m of unknowns that every frame shares
///
/// Block Cholesky A = L Lᵀ, then the Schur complement C − Bᵀ A⁻¹ B for the border. Work grows linearly with
/// the number of frames. The columns of the border do not know of each other: they are divided among threads
/// in chunks of fixed width, so the bytes are those of one thread.
#pragma once

#include <Eigen/Core>

#include "core/containers.h"
#include "core/random.h"

namespace mimicx::motion::fit {

struct BorderedBand {
  using MatrixXd = Eigen::MatrixXd;
  using VectorXd = Eigen::VectorXd;

  PerFrame<MatrixXd> diagonal;  ///< [frames] n × n: block (t, t)
  PerFrame<MatrixXd> next;      ///< [frames] n × n: block (t + 1, t); unused for the last frame
  PerFrame<MatrixXd> second;    ///< [frames] n × n: block (t + 2, t); unused for the last two
  PerFrame<MatrixXd> border;    ///< [frames] n × m: rows of B
  MatrixXd corner;              ///< m × m: C
  PerFrame<VectorXd> rhs;       ///< [frames] n: a
  VectorXd rhs_border;          ///< m: b

  /// All zero.
  BorderedBand(int frames, int n, int m);
  int frames() const { return diagonal.count(); }
};

struct BandSolution {
  PerFrame<Eigen::VectorXd> x;  ///< [frames] n
  Eigen::VectorXd g;            ///< m
};

/// Solves the system; overwrites it with its factors.
/// @param threads  no influence on the result
/// @throws std::domain_error when it is not positive definite
BandSolution solve(BorderedBand& system, int threads = 1);

/// A draw from the normal distribution whose inverse covariance is the matrix of a system that `solve` has
/// factored: the solution's error under the model.  docs/method.md, "Keypoint fit", (10)
/// @param random  advanced
BandSolution draw(const BorderedBand& factored, Random& random);

}  // namespace mimicx::motion::fit
