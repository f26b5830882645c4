/// The linear system of the keypoint fit, docs/method.md, "Keypoint fit", (9): a symmetric positive definite
/// block band with a border.
///
///   ⎡ A   B ⎤ ⎡ x ⎤   ⎡ a ⎤     A: frames × frames blocks of n × n, block bandwidth 2 (neighbours and
///   ⎣ Bᵀ  C ⎦ ⎣ g ⎦ = ⎣ b ⎦        the frames after them); C: m × m of unknowns that every frame shares
///
/// Block Cholesky A = L Lᵀ, then the Schur complement C − Bᵀ A⁻¹ B for the border. Work grows linearly with
/// the number of frames.
///
/// The border is as large as the rest of the system and is needed twice: for the Schur complement, and to
/// subtract B g from the frames' right side once g is known. To save memory it is computed twice, a few
/// frames at a time, and never stored as a whole. Its columns are independent: threads share them in chunks
/// of fixed width, so the result does not depend on the number of threads.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "core/containers.h"
#include "core/random.h"

namespace mimicx::fit {

/// Computes B: writes the n × m rows of the frames first, first + 1, … Called by several threads at once.
using Border = std::function<void(int first, std::span<Eigen::MatrixXd> rows)>;

struct BorderedBand {
  using MatrixXd = Eigen::MatrixXd;
  using VectorXd = Eigen::VectorXd;

  PerFrame<MatrixXd> diagonal;  ///< [frames] n × n: block (t, t)
  PerFrame<MatrixXd> next;      ///< [frames] n × n: block (t + 1, t); unused for the last frame
  PerFrame<MatrixXd> second;    ///< [frames] n × n: block (t + 2, t); unused for the last two
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

/// A solution, and samples of its error from the normal distribution whose inverse covariance is the matrix
/// of the system.  docs/method.md, "Keypoint fit", (10)
struct SolutionWithDraws : BandSolution {
  std::vector<BandSolution> draws;
};

/// Solves the system. Its factors overwrite it.
/// @param draws    number of samples of the error
/// @param random   advanced by the draws
/// @param threads  without influence on the result
/// @throws std::domain_error when it is not positive definite
SolutionWithDraws solve(BorderedBand& system, const Border& border, int draws, Random& random,
                        int threads = 1);
/// The same without draws.
BandSolution solve(BorderedBand& system, const Border& border, int threads = 1);

}  // namespace mimicx::fit
