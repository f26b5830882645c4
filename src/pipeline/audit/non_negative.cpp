#include "pipeline/audit/non_negative.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>
#include <vector>

namespace mimicx::pipeline::audit {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kMostSteps = 200;    ///< seen: under 20; the bound holds even where rounding would go in circles
constexpr double kNoSlope = 1e-13;  ///< of φ, in parts of ‖b‖, below which rounding is all that is left

/// Where φ is smallest on the way from r to r + d, as a part of it. `at` = Aᵀr, `change` = Aᵀd.
double smallest_on_the_way(const Vector6d& r, const Vector6d& d, const Vector6d& b,
                           const Eigen::VectorXd& at, const Eigen::VectorXd& change, double small) {
  // The slope along d is piecewise linear and grows: offset + part · growth between two planes.
  double offset = (r - b).dot(d), growth = d.squaredNorm();
  std::vector<std::pair<double, Eigen::Index>> planes;  // part of the way, column
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    if (at[i] > 0.0 || (at[i] == 0.0 && change[i] > 0.0)) {
      offset += at[i] * change[i] / small;
      growth += change[i] * change[i] / small;
    }
    if (at[i] * change[i] < 0.0 && -at[i] / change[i] < 1.0) planes.emplace_back(-at[i] / change[i], i);
  }
  std::sort(planes.begin(), planes.end());
  for (const auto& [part, i] : planes) {
    if (offset + part * growth >= 0.0) break;
    const double sign = change[i] > 0.0 ? 1.0 : -1.0;  // the column begins, or ceases, to count
    offset += sign * at[i] * change[i] / small;
    growth += sign * change[i] * change[i] / small;
  }
  return std::clamp(-offset / growth, 0.0, 1.0);
}

}  // namespace

Eigen::VectorXd non_negative_least_squares(const Matrix6X& A, const Vector6d& b, double small) {
  Vector6d r = b;
  Eigen::VectorXd at = A.transpose() * r;
  for (int step = 0; step < kMostSteps; ++step) {
    Matrix6d hessian = Matrix6d::Identity();
    for (Eigen::Index i = 0; i < A.cols(); ++i)
      if (at[i] > 0.0) hessian.noalias() += A.col(i) * (A.col(i).transpose() / small);
    const Vector6d slope = hessian * r - b;
    if (slope.norm() <= kNoSlope * b.norm()) break;
    const Vector6d d = hessian.ldlt().solve(b) - r;
    const Eigen::VectorXd change = A.transpose() * d;
    const double part = smallest_on_the_way(r, d, b, at, change, small);
    if (part == 0.0) break;
    r += part * d;
    const Eigen::VectorXd next = A.transpose() * r;
    const bool same_piece = ((at.array() > 0.0) == (next.array() > 0.0)).all();
    at = next;
    if (part == 1.0 && same_piece) break;
  }
  return at.cwiseMax(0.0) / small;
}

}  // namespace mimicx::pipeline::audit
