#include "audit/non_negative_least_squares.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/decompositions.h"

namespace mimicx::audit {
namespace {

constexpr int kMostSteps = 200;     ///< observed: under 20; bounds the loop even if rounding causes a cycle
constexpr double kNoSlope = 1e-13;  ///< of φ, in parts of ‖b‖, below which only rounding is left

/// The line r + part · d on which φ is minimised.
struct SearchLine {
  Eigen::VectorXd r, d;
  Eigen::VectorXd at, change;  ///< Aᵀr, Aᵀd

  /// Slope of φ along d.
  double slope(double part, const Eigen::VectorXd& b, double small) const {
    return (r + part * d - b).dot(d) + (at + part * change).cwiseMax(0.0).dot(change) / small;
  }
};

/// The part in [0, 1] at which φ is smallest on the line: its slope, piecewise linear and nondecreasing, is 0
/// there.
double smallest_on(const SearchLine& line, const Eigen::VectorXd& b, double small) {
  const Eigen::VectorXd &at = line.at, &change = line.change;
  const auto slope = [&](double part) { return line.slope(part, b, small); };
  std::vector<double> planes = {1.0};
  for (Eigen::Index i = 0; i < at.size(); ++i)
    if (at[i] * change[i] < 0.0 && std::abs(at[i]) < std::abs(change[i]))
      planes.push_back(-at[i] / change[i]);
  std::sort(planes.begin(), planes.end());
  const auto beyond =
      std::partition_point(planes.begin(), planes.end(), [&](double part) { return slope(part) < 0.0; });
  if (beyond == planes.end()) return 1.0;
  const double low = beyond == planes.begin() ? 0.0 : *(beyond - 1), high = *beyond;
  const double at_low = slope(low), at_high = slope(high);
  if (!(at_low < 0.0)) return low;
  return low + (high - low) * (-at_low / (at_high - at_low));
}

}  // namespace

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double small) {
  Eigen::VectorXd r = b, at = A.transpose() * r;
  int settled = 0;  // full steps inside one piece: the second corrects the rounding of the first
  for (int step = 0; step < kMostSteps && settled < 2; ++step) {
    const Eigen::VectorXd slope = r - b + A * at.cwiseMax(0.0) / small;
    if (slope.norm() <= kNoSlope * b.norm()) break;
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Identity(b.size(), b.size());
    for (Eigen::Index i = 0; i < A.cols(); ++i)
      if (at[i] > 0.0) hessian.noalias() += A.col(i) * (A.col(i).transpose() / small);
    const Eigen::VectorXd d = -solve_symmetric(hessian, slope);
    const double part = smallest_on({r, d, at, A.transpose() * d}, b, small);
    if (part == 0.0) break;
    r += part * d;
    const Eigen::VectorXd next = A.transpose() * r;
    const bool same_piece = ((at.array() > 0.0) == (next.array() > 0.0)).all();
    at = next;
    if (part == 1.0 && same_piece) ++settled;
  }
  return at.cwiseMax(0.0) / small;
}

}  // namespace mimicx::audit
