/// Smooth corrections of a stretch of frames: N unknowns a frame that are small, bend little, and are zero
/// beside the stretch.
///
/// They minimise  Σ r²  +  Σ_t ‖c_t‖²/σ_c²  +  Σ_t ‖c_{t+1} − 2 c_t + c_{t−1}‖²/σ_b²  by Gauss–Newton, with
/// residuals r of single frames. At the first and last frame of the motion corrections need not fade.
#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <vector>

#include "core/containers.h"

namespace mimicx::motion {

/// Frames first … last − 1.
struct FrameSpan {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

/// Stretches that contain the given frames and `around` more to either side; those that meet are one.
inline List<FrameSpan> stretches_around(const PerFrame<bool>& chosen, int around) {
  List<FrameSpan> stretches;
  for (int t = 0; t < chosen.count(); ++t) {
    if (!chosen[t]) continue;
    const int first = std::max(t - around, 0), last = std::min(t + around + 1, chosen.count());
    if (!stretches.empty() && first <= stretches.back().last)
      stretches.back().last = last;
    else
      stretches.push_back({first, last});
  }
  return stretches;
}

/// How a correction is held.
struct CorrectionSigmas {
  double size;                         ///< σ_c
  double bend;                         ///< σ_b at 30 frames per second
  double largest_step, smallest_step;  ///< of an unknown in an iteration: bound, and where it has converged
  int iterations;
  double least_share = 0.25;  ///< of a step: where it does not lower the cost, either, the search ends
};

/// The normal equations of one iteration.
template <int N>
class CorrectionEquations {
 public:
  using Unknowns = Eigen::Matrix<double, N, 1>;

  /// @param frames  of the motion. @param c  [stretch] the state
  CorrectionEquations(const FrameSpan& stretch, int frames, double fps, const CorrectionSigmas& sigmas,
                      const List<Unknowns>& c)
      : rhs_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(N) * stretch.size())) {
    const double rate = 900.0 / (fps * fps), bend = 1.0 / (rate * rate * sigmas.bend * sigmas.bend);
    for (int i = 0; i < stretch.size(); ++i) add(c, {{i, 1.0}}, 1.0 / (sigmas.size * sigmas.size));
    for (int i = -1; i <= stretch.size(); ++i) {
      const int middle = stretch.first + i;
      if (middle >= 1 && middle + 1 < frames) add(c, {{i - 1, 1.0}, {i, -2.0}, {i + 1, 1.0}}, bend);
    }
  }

  /// A residual of frame i of the stretch, with its derivative by the frame's unknowns.
  void add(int i, const Unknowns& slope, double residual, double sigma) {
    const double weight = 1.0 / (sigma * sigma);
    cost_ += weight * residual * residual;
    rhs_.segment<N>(N * i) -= weight * residual * slope;
    for (int row = 0; row < N; ++row)
      for (int column = 0; column < N; ++column)
        entries_.emplace_back(N * i + row, N * i + column, weight * slope[row] * slope[column]);
  }

  double cost() const { return cost_; }

  Eigen::VectorXd step() const {
    Eigen::SparseMatrix<double> A(rhs_.size(), rhs_.size());
    A.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>(A)
        .solve(rhs_);
  }

 private:
  struct Share {
    int i;
    double factor;
  };
  /// ‖Σ factor c_i‖² with a weight; c is zero beside the stretch.
  void add(const List<Unknowns>& c, const std::vector<Share>& shares, double weight) {
    const auto inside = [&](const Share& s) { return s.i >= 0 && s.i < c.count(); };
    Unknowns residual = Unknowns::Zero();
    for (const Share& s : shares)
      if (inside(s)) residual += s.factor * c[s.i];
    cost_ += weight * residual.squaredNorm();
    for (const Share& s : shares) {
      if (!inside(s)) continue;
      rhs_.segment<N>(N * s.i) -= weight * s.factor * residual;
      for (const Share& other : shares)
        for (int k = 0; inside(other) && k < N; ++k)
          entries_.emplace_back(N * s.i + k, N * other.i + k, weight * s.factor * other.factor);
    }
  }

  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd rhs_;
  double cost_ = 0.0;
};

template <int N>
struct SmoothCorrection {
  List<Eigen::Matrix<double, N, 1>> c;  ///< [stretch]
  double cost = 0;
};

/// A step that does not lower the cost is halved.
/// @param add_residuals  (c, equations): adds the residuals of a state to its equations
template <int N, class AddResiduals>
SmoothCorrection<N> smooth_correction(const FrameSpan& stretch, int frames, double fps,
                                      const CorrectionSigmas& sigmas, const AddResiduals& add_residuals) {
  using Unknowns = Eigen::Matrix<double, N, 1>;
  const auto equations_at = [&](const List<Unknowns>& c) {
    CorrectionEquations<N> equations(stretch, frames, fps, sigmas, c);
    add_residuals(c, equations);
    return equations;
  };
  SmoothCorrection<N> found{List<Unknowns>(stretch.size(), Unknowns::Zero()), 0.0};
  CorrectionEquations<N> here = equations_at(found.c);
  for (int iteration = 0; iteration < sigmas.iterations; ++iteration) {
    const Eigen::VectorXd step = here.step();
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest < sigmas.smallest_step) break;
    double share = std::min(1.0, sigmas.largest_step / largest);
    const double least = sigmas.least_share * share;
    bool lower = false;
    for (; !lower && share >= least; share *= 0.5) {
      List<Unknowns> c = found.c;
      for (int i = 0; i < stretch.size(); ++i)
        c[i] += share * step.segment<N>(static_cast<Eigen::Index>(N) * i);
      CorrectionEquations<N> there = equations_at(c);
      lower = there.cost() < here.cost();
      if (lower) found.c = std::move(c), here = std::move(there);
    }
    if (!lower) break;
  }
  found.cost = here.cost();
  return found;
}

}  // namespace mimicx::motion
