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

/// B ← L⁻¹ B, then C ← C − BᵀB, in chunks of columns.
void eliminate_border(BorderedBand& s, int threads) {
  static constexpr Eigen::Index kColumns = 64;
  const Eigen::Index columns = s.corner.cols();
  const auto columns_of = [columns](MatrixXd& m, int chunk) {
    return m.middleCols(chunk * kColumns, std::min(kColumns, columns - chunk * kColumns));
  };
  const auto chunks = static_cast<int>((columns + kColumns - 1) / kColumns);
  parallel_for(chunks, threads, [&](int chunk) {
    for (int t = 0; t < s.frames(); ++t) {
      auto here = columns_of(s.border[t], chunk);
      if (t >= 1) here.noalias() -= s.next[t - 1] * columns_of(s.border[t - 1], chunk);
      if (t >= 2) here.noalias() -= s.second[t - 2] * columns_of(s.border[t - 2], chunk);
      s.diagonal[t].triangularView<Eigen::Lower>().solveInPlace(here);
    }
  });
  parallel_for(chunks, threads, [&](int chunk) {
    auto here = columns_of(s.corner, chunk);
    for (MatrixXd& border : s.border) here.noalias() -= border.transpose() * columns_of(border, chunk);
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

}  // namespace

BorderedBand::BorderedBand(int frames, int n, int m)
    : diagonal(frames, MatrixXd::Zero(n, n)),
      next(diagonal),
      second(diagonal),
      border(frames, MatrixXd::Zero(n, m)),
      corner(MatrixXd::Zero(m, m)),
      rhs(frames, VectorXd::Zero(n)),
      rhs_border(VectorXd::Zero(m)) {}

BandSolution solve(BorderedBand& s, int threads) {
  factorise(s);
  eliminate_border(s, threads);
  forward(s, s.rhs);
  for (int t = 0; t < s.frames(); ++t) s.rhs_border.noalias() -= s.border[t].transpose() * s.rhs[t];
  const Eigen::LLT<Eigen::Ref<MatrixXd>> factor(s.corner);
  require_definite(factor);
  BandSolution out{std::move(s.rhs), factor.solve(s.rhs_border)};
  for (int t = 0; t < s.frames(); ++t) out.x[t].noalias() -= s.border[t] * out.g;
  backward(s, out.x);
  return out;
}

BandSolution draw(const BorderedBand& s, Random& random) {
  BandSolution out{{}, VectorXd(s.corner.rows())};
  for (double& value : out.g) value = random.normal();
  s.corner.transpose().triangularView<Eigen::Upper>().solveInPlace(out.g);
  for (int t = 0; t < s.frames(); ++t) {
    VectorXd x(s.diagonal[t].rows());
    for (double& value : x) value = random.normal();
    out.x.push_back(x - s.border[t] * out.g);
  }
  backward(s, out.x);
  return out;
}

}  // namespace mimicx::motion::fit
