#include "motion/prepare/joint_ranges.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "character/joint_range.h"
#include "core/units.h"

namespace mimicx::motion {
namespace {

constexpr double kRangeMargin = 0.3 * kDegree;  ///< d₀
constexpr double kSigmaBeyond = 0.1 * kDegree;
constexpr double kSigmaRangeTurn = 15.0 * kDegree;
constexpr double kSigmaRangeBend = 1.0 * kDegree;  ///< second difference at 30 frames per second
constexpr double kSurroundings = 1.0 / 3.0;        ///< s before and after frames beyond the range
constexpr int kRangeIterations = 10;
constexpr double kLargestRangeStep = 0.3, kSmallestRangeStep = 1e-5;  ///< rad

/// Frames first … last − 1 whose turns are unknowns.
struct Span {
  int first, last;
};

/// Turns of a joint over a stretch, as rows of three entries; zero outside of it.
using Turns3 = List<Vector3d>;

/// A joint over a stretch of frames.
struct JointOverStretch {
  const Reference& reference;
  int body;
  Span span;

  int size() const { return span.last - span.first; }
  Quaterniond turned(int i, const Vector3d& c) const {
    return reference.frames[span.first + i].q[body] * exp_map(c);
  }
  RangeDistance distance(int i, const Vector3d& c) const {
    RangeDistance d = range_distance(reference.character.joint[body], body, turned(i, c));
    const Vector3d axis = hinge_or_zero();
    if (is_hinge(body)) d.slope = axis * axis.dot(d.slope);
    return d;
  }
  Vector3d hinge_or_zero() const { return is_hinge(body) ? hinge_axis(body) : Vector3d(Vector3d::Zero()); }
};

/// A Gauss–Newton step of all turns. Turns are small: exp(c + δ) ≈ exp(c) exp(δ).
Eigen::VectorXd range_step(const JointOverStretch& joint, const Turns3& c) {
  const int n = joint.size();
  const double rate = 900.0 / (joint.reference.fps * joint.reference.fps);
  const double of_size = 1.0 / (kSigmaRangeTurn * kSigmaRangeTurn),
               of_bend = 1.0 / (rate * rate * kSigmaRangeBend * kSigmaRangeBend),
               of_beyond = 1.0 / (kSigmaBeyond * kSigmaBeyond);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(3 * n);
  const auto at = [&](int i) { return i < 0 || i >= n ? Vector3d(Vector3d::Zero()) : c[i]; };
  for (int i = 0; i < n; ++i) {
    const RangeDistance d = joint.distance(i, c[i]);
    const double beyond = std::max(0.0, d.excess + kRangeMargin);
    const Vector3d slope = beyond > 0.0 ? d.slope : Vector3d(Vector3d::Zero());
    rhs.segment<3>(3 * i) -= of_beyond * beyond * slope + of_size * c[i];
    const Matrix3d block = of_beyond * slope * slope.transpose() + of_size * Matrix3d(Matrix3d::Identity());
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        entries.emplace_back(3 * i + row, 3 * i + column, block(row, column));
  }
  // At the ends of the motion turns need not fade; at those of the stretch the frames beside it have none.
  for (int i = -1; i <= n; ++i) {
    const int middle = joint.span.first + i;
    if (middle < 1 || middle + 1 >= joint.reference.size()) continue;
    const Vector3d bend = at(i - 1) - 2.0 * at(i) + at(i + 1);
    const Array<double, 3> share = {1.0, -2.0, 1.0};
    for (int j = 0; j < 3; ++j) {
      if (i + j - 1 < 0 || i + j - 1 >= n) continue;
      rhs.segment<3>(3 * (i + j - 1)) -= of_bend * share[j] * bend;
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; i + k - 1 >= 0 && i + k - 1 < n && axis < 3; ++axis)
          entries.emplace_back(3 * (i + j - 1) + axis, 3 * (i + k - 1) + axis, of_bend * share[j] * share[k]);
    }
  }
  Eigen::SparseMatrix<double> A(rhs.size(), rhs.size());
  A.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>(A)
      .solve(rhs);
}

/// The smallest further turn that brings a joint to the surface of its range, or inside.
Vector3d onto_surface(const JointOverStretch& joint, int i, Vector3d c) {
  constexpr int kNewton = 20;
  for (int k = 0; k < kNewton; ++k) {
    const RangeDistance d = joint.distance(i, c);
    if (d.excess <= 0.0) break;
    const Vector3d back = -(d.excess + 1e-9) / d.slope.squaredNorm() * d.slope;
    c = log_map(exp_map(c) * exp_map(back));
  }
  return c;
}

Turns3 turns_into_range(const JointOverStretch& joint) {
  Turns3 c(joint.size(), Vector3d::Zero());
  for (int iteration = 0; iteration < kRangeIterations; ++iteration) {
    const Eigen::VectorXd step = range_step(joint, c);
    const double largest = step.cwiseAbs().maxCoeff();
    const double scale = std::min(1.0, kLargestRangeStep / std::max(largest, kSmallestRangeStep));
    for (int i = 0; i < joint.size(); ++i) c[i] += scale * step.segment<3>(3 * i);
    if (largest < kSmallestRangeStep) break;
  }
  for (int i = 0; i < joint.size(); ++i) c[i] = onto_surface(joint, i, c[i]);
  return c;
}

/// Stretches around the frames in which a joint is beyond its range.
List<Span> stretches_of(const PerFrame<bool>& beyond, int around) {
  List<Span> spans;
  for (int t = 0; t < beyond.count(); ++t) {
    if (!beyond[t]) continue;
    const int first = std::max(t - around, 0), last = std::min(t + around + 1, beyond.count());
    if (!spans.empty() && first <= spans.back().last)
      spans.back().last = last;
    else
      spans.push_back({first, last});
  }
  return spans;
}

/// Turns a body by its joint. Bodies below it keep their orientations in the world, unless their joints are
/// hinges.
void turn_alone(int body, const Vector3d& c, PerBody<Quaterniond>& q) {
  const Quaterniond turn = exp_map(c);
  q[body] = (q[body] * turn).normalized();
  for (int child = body + 1; child < kBodies; ++child)
    if (kParents[child] == body && !is_hinge(child)) q[child] = (turn.conjugate() * q[child]).normalized();
}

}  // namespace

RangeReport turn_into_ranges(Reference& reference) {
  RangeReport report;
  const int frames = reference.size(), around = static_cast<int>(std::ceil(kSurroundings * reference.fps));
  const auto excess = [&](int t, int body) {
    return range_distance(reference.character.joint[body], body, reference.frames[t].q[body]).excess;
  };
  for (int t = 0; t < frames; ++t) {
    bool any = false;
    for (int body = 1; body < kBodies; ++body) {
      const double beyond = excess(t, body);
      any = any || beyond > 0.0;
      if (beyond > report.farthest) report.farthest = beyond, report.body = body;
    }
    report.frames += any ? 1 : 0;
  }
  if (report.frames == 0) return report;
  for (int body = 1; body < kBodies; ++body) {
    PerFrame<bool> beyond;
    for (int t = 0; t < frames; ++t) beyond.push_back(excess(t, body) > 0.0);
    for (const Span& span : stretches_of(beyond, around)) {
      const JointOverStretch joint{reference, body, span};
      const Turns3 c = turns_into_range(joint);
      for (int i = 0; i < joint.size(); ++i) turn_alone(body, c[i], reference.frames[span.first + i].q);
    }
  }
  return report;
}

}  // namespace mimicx::motion
