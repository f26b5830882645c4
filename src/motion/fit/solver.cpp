#include "motion/fit/solver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/parallel.h"

namespace mimicx::motion::fit {
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
    if (t >= 1) D.noalias() -= s.next[t - 1] * s.next[t - 1].transpose();
    if (t >= 2) D.noalias() -= s.second[t - 2] * s.second[t - 2].transpose();
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

/// Calls use(first, rows) for the rows of L⁻¹ B of the frames first, first + 1, …, some frames at a time.
template <class Use>
void for_each_eliminated(const BorderedBand& s, const Border& border, int threads, const Use& use) {
  constexpr int kFrames = 32, kPart = 8;
  static constexpr Eigen::Index kColumns = 64;
  const Eigen::Index columns = s.corner.cols();
  const auto chunks = static_cast<int>((columns + kColumns - 1) / kColumns);
  List<MatrixXd> blocks(kFrames + 2);  // of two frames before, then of the frames from `first` on
  for (int first = 0; first < s.frames(); first += kFrames) {
    const int count = std::min(kFrames, s.frames() - first);
    parallel_for((count + kPart - 1) / kPart, threads, [&](int part) {
      const int at = part * kPart;
      border(first + at, std::span(blocks).subspan(static_cast<std::size_t>(2 + at),
                                                   static_cast<std::size_t>(std::min(kPart, count - at))));
    });
    parallel_for(chunks, threads, [&](int chunk) {
      const auto columns_of = [&](MatrixXd& m) {
        return m.middleCols(chunk * kColumns, std::min(kColumns, columns - chunk * kColumns));
      };
      for (int k = 0; k < count; ++k) {
        const int t = first + k;
        auto here = columns_of(blocks[2 + k]);
        if (t >= 1) here.noalias() -= s.next[t - 1] * columns_of(blocks[1 + k]);
        if (t >= 2) here.noalias() -= s.second[t - 2] * columns_of(blocks[k]);
        s.diagonal[t].triangularView<Eigen::Lower>().solveInPlace(here);
      }
    });
    use(first, std::span<const MatrixXd>(blocks).subspan(2, static_cast<std::size_t>(count)));
    if (count == kFrames) blocks[0].swap(blocks[kFrames]), blocks[1].swap(blocks[kFrames + 1]);
  }
}

/// C ← C − Bᵀ A⁻¹ B and b ← b − Bᵀ A⁻¹ a from a ← L⁻¹ a. The columns of C in chunks.
void eliminate_border(BorderedBand& s, const Border& border, int threads) {
  static constexpr Eigen::Index kColumns = 64;
  const Eigen::Index columns = s.corner.cols();
  const auto chunks = static_cast<int>((columns + kColumns - 1) / kColumns);
  for_each_eliminated(s, border, threads, [&](int first, std::span<const MatrixXd> blocks) {
    parallel_for(chunks, threads, [&](int chunk) {
      const Eigen::Index at = chunk * kColumns, count = std::min(kColumns, columns - at);
      for (const MatrixXd& rows : blocks)
        s.corner.middleCols(at, count).noalias() -= rows.transpose() * rows.middleCols(at, count);
    });
    for (const MatrixXd& rows : blocks) s.rhs_border.noalias() -= rows.transpose() * s.rhs[first++];
  });
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
  eliminate_border(s, border, threads);
  const Eigen::LLT<Eigen::Ref<MatrixXd>> factor(s.corner);
  require_definite(factor);
  SolutionWithDraws out{{std::move(s.rhs), factor.solve(s.rhs_border)}, {}};
  for (int i = 0; i < draws; ++i) {
    BandSolution& draw = out.draws.emplace_back(noise_like(out, random));
    s.corner.transpose().triangularView<Eigen::Upper>().solveInPlace(draw.g);
  }
  for_each_eliminated(s, border, threads, [&](int first, std::span<const MatrixXd> blocks) {
    for (const MatrixXd& rows : blocks) {
      out.x[first].noalias() -= rows * out.g;
      for (BandSolution& draw : out.draws) draw.x[first] -= rows * draw.g;
      ++first;
    }
  });
  backward(s, out.x);
  for (BandSolution& draw : out.draws) backward(s, draw.x);
  return out;
}

BandSolution solve(BorderedBand& s, const Border& border, int threads) {
  Random unused(0, {});
  return solve(s, border, 0, unused, threads);
}

}  // namespace mimicx::motion::fit
