#include "fit/least_squares/bordered_band.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/parallel.h"

namespace mimicx::fit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void require_definite(const Eigen::LLT<Eigen::Ref<MatrixXd>>& factor) {
  if (factor.info() != Eigen::Success)
    throw std::domain_error("keypoint fit: the system is not positive definite");
}

/// diagonal, next, second ← the blocks of L. In place, frame by frame.
void factorise(BorderedBand& s) {
  const int frames = s.frames();
  for (int t = 0; t < frames; ++t) {
    MatrixXd& D = s.diagonal[t];
    if (t >= 1) D.triangularView<Eigen::Lower>() -= s.next[t - 1] * s.next[t - 1].transpose();
    if (t >= 2) D.triangularView<Eigen::Lower>() -= s.second[t - 2] * s.second[t - 2].transpose();
    require_definite(Eigen::LLT<Eigen::Ref<MatrixXd>>(D));
    const auto transposed = std::as_const(D).transpose().triangularView<Eigen::Upper>();  // Lᵀ
    if (t + 1 < frames) {
      if (t >= 1) s.next[t].noalias() -= s.second[t - 1] * s.next[t - 1].transpose();
      transposed.solveInPlace<Eigen::OnTheRight>(s.next[t]);
    }
    if (t + 2 < frames) transposed.solveInPlace<Eigen::OnTheRight>(s.second[t]);
  }
}

/// y ← L⁻¹ y
void forward(const BorderedBand& s, PerFrame<VectorXd>& y) {
  for (int t = 0; t < y.count(); ++t) {
    if (t >= 1) y[t].noalias() -= s.next[t - 1] * y[t - 1];
    if (t >= 2) y[t].noalias() -= s.second[t - 2] * y[t - 2];
    s.diagonal[t].triangularView<Eigen::Lower>().solveInPlace(y[t]);
  }
}

constexpr int kBlock = 512;            ///< frames of the border in memory at once
constexpr Eigen::Index kColumns = 64;  ///< columns of the border in a chunk

int chunks_of(const BorderedBand& s) { return static_cast<int>((s.corner.cols() + kColumns - 1) / kColumns); }

/// Calls use(first, rows) for the rows of L⁻¹ B of the frames first, first + 1, …, block by block.
template <class Use>
void for_each_eliminated(const BorderedBand& s, const Border& border, int threads, const Use& use) {
  constexpr int kPart = 16;
  const Eigen::Index columns = s.corner.cols();
  List<MatrixXd> rows;
  Array<MatrixXd, 2> before;  // the two frames before the block, the last one first
  for (int first = 0; first < s.frames(); first += kBlock) {
    rows.resize(std::min(kBlock, s.frames() - first));
    parallel_for((rows.count() + kPart - 1) / kPart, threads, [&](int part) {
      const int at = part * kPart, count = std::min(kPart, rows.count() - at);
      border(first + at,
             std::span(rows).subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(count)));
    });
    parallel_for(chunks_of(s), threads, [&](int chunk) {
      const auto part_of = [&](int t) {
        MatrixXd& all = t >= first ? rows[t - first] : before[first - 1 - t];
        return all.middleCols(chunk * kColumns, std::min(kColumns, columns - chunk * kColumns));
      };
      for (int t = first; t < first + rows.count(); ++t) {
        auto here = part_of(t);
        if (t >= 1) here.noalias() -= s.next[t - 1] * part_of(t - 1);
        if (t >= 2) here.noalias() -= s.second[t - 2] * part_of(t - 2);
        s.diagonal[t].triangularView<Eigen::Lower>().solveInPlace(here);
      }
    });
    use(first, rows);
    if (first + kBlock < s.frames()) before[0].swap(rows[kBlock - 1]), before[1].swap(rows[kBlock - 2]);
  }
}

/// C ← C − Bᵀ A⁻¹ B, its lower triangle, and b ← b − Bᵀ A⁻¹ a from a ← L⁻¹ a. The columns of C in chunks.
/// @return L⁻¹ B where that is one block
List<MatrixXd> eliminate_border(BorderedBand& s, const Border& border, int threads) {
  List<MatrixXd> kept;
  for_each_eliminated(s, border, threads, [&](int first, List<MatrixXd>& rows) {
    parallel_for(chunks_of(s), threads, [&](int chunk) {
      const Eigen::Index at = chunk * kColumns, below = s.corner.cols() - at;
      for (const MatrixXd& frame : rows)
        s.corner.block(at, at, below, std::min(kColumns, below)).noalias() -=
            frame.rightCols(below).transpose() * frame.middleCols(at, std::min(kColumns, below));
    });
    for (int k = 0; k < rows.count(); ++k) s.rhs_border.noalias() -= rows[k].transpose() * s.rhs[first + k];
    if (rows.count() == s.frames()) kept = std::move(rows);
  });
  return kept;
}

/// y ← L⁻ᵀ y
void backward(const BorderedBand& s, PerFrame<VectorXd>& y) {
  for (int t = y.count() - 1; t >= 0; --t) {
    if (t + 1 < y.count()) y[t].noalias() -= s.next[t].transpose() * y[t + 1];
    if (t + 2 < y.count()) y[t].noalias() -= s.second[t].transpose() * y[t + 2];
    s.diagonal[t].transpose().triangularView<Eigen::Upper>().solveInPlace(y[t]);
  }
}

/// Normal numbers in the shape of a solution.
BandSolution noise_like(const BandSolution& solution, Random& random) {
  BandSolution noise = solution;
  for (double& value : noise.g) value = random.normal();
  for (VectorXd& x : noise.x)
    for (double& value : x) value = random.normal();
  return noise;
}

}  // namespace

BorderedBand::BorderedBand(int frames, int n, int m)
    : diagonal(frames, MatrixXd::Zero(n, n)),
      next(diagonal),
      second(diagonal),
      corner(MatrixXd::Zero(m, m)),
      rhs(frames, VectorXd::Zero(n)),
      rhs_border(VectorXd::Zero(m)) {}

SolutionWithDraws solve(BorderedBand& s, const Border& border, int draws, Random& random, int threads) {
  factorise(s);
  forward(s, s.rhs);
  const List<MatrixXd> kept = eliminate_border(s, border, threads);
  const Eigen::LLT<Eigen::Ref<MatrixXd>> factor(s.corner);
  require_definite(factor);
  SolutionWithDraws out{{std::move(s.rhs), factor.solve(s.rhs_border)}, {}};
  for (int i = 0; i < draws; ++i) {
    BandSolution& draw = out.draws.emplace_back(noise_like(out, random));
    s.corner.transpose().triangularView<Eigen::Upper>().solveInPlace(draw.g);
  }
  List<BandSolution*> all = {&out};
  for (BandSolution& draw : out.draws) all.push_back(&draw);
  const auto subtract = [&](int first, const List<MatrixXd>& rows) {
    parallel_for(all.count(), threads, [&](int i) {
      for (int k = 0; k < rows.count(); ++k) all[i]->x[first + k].noalias() -= rows[k] * all[i]->g;
    });
  };
  if (kept.empty())
    for_each_eliminated(s, border, threads, subtract);
  else
    subtract(0, kept);
  parallel_for(all.count(), threads, [&](int i) { backward(s, all[i]->x); });
  return out;
}

BandSolution solve(BorderedBand& s, const Border& border, int threads) {
  Random unused(0, {});
  return solve(s, border, 0, unused, threads);
}

}  // namespace mimicx::fit
