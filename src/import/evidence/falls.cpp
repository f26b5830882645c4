#include "import/evidence/falls.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/quantile.h"

namespace mimicx::import {
namespace {

constexpr double kHumanLeg = 0.784;  ///< m; for the radii below

/// Roughly the centre of mass.
Vector3d rough_center(const Landmarks& pose) {
  return 0.22 * pose.between(kLeftHip, kRightHip) + 0.26 * pose.between(kLeftShoulder, kRightShoulder) +
         0.22 * pose.between(kLeftKnee, kRightKnee) + 0.1 * pose.between(kLeftAnkle, kRightAnkle) +
         0.12 * pose.between(kLeftElbow, kRightElbow) + 0.08 * pose.p[kHead];
}

/// The quadratic coefficient of a path's least-squares parabola over −1 … 1. @param place  of frame 0 … n − 1
template <class Place>
Vector3d curvature_of(int n, const Place& place, double& residual) {
  Eigen::MatrixX3d powers(n, 3), values(n, 3);
  for (int i = 0; i < n; ++i) {
    const double s = (2.0 * i + 1.0) / n - 1.0;
    powers.row(i) << 1.0, s, s * s;
    values.row(i) = place(i);
  }
  const Matrix3d normal = powers.transpose() * powers;
  const Matrix3d c = normal.inverse() * (powers.transpose() * values);
  residual = (powers * c - values).norm() / std::sqrt(n);
  return c.row(2);
}

}  // namespace

double radius_of(int body) {
  switch (body) {
    case kLeftAnkle:
    case kRightAnkle:
      return 0.08 / kHumanLeg;
    case kLeftFoot:
    case kRightFoot:
      return 0.03 / kHumanLeg;
    case kLeftWrist:
    case kRightWrist:
      return 0.04 / kHumanLeg;
    case kLeftKnee:
    case kRightKnee:
    case kLeftElbow:
    case kRightElbow:
      return 0.05 / kHumanLeg;
    default:
      return 0.1 / kHumanLeg;
  }
}

RoughBody rough_body_of(const PerFrame<Landmarks>& poses) {
  RoughBody body;
  const double leg = leg_length(poses);
  std::vector<double> speeds;
  for (const Landmarks& pose : poses) {
    body.center.push_back(rough_center(pose) / leg);
    auto& p = body.p.emplace_back();
    for (int b = 0; b < kBodies; ++b) p[b] = pose.p[b] / leg;
    const int t = body.p.count() - 1;
    if (t > 0)
      for (int b = 0; b < kBodies; ++b) speeds.push_back((p[b] - body.p[t - 1][b]).norm());
  }
  body.speed = speeds.empty() ? 0.0 : median(speeds);
  return body;
}

std::pair<int, double> lowest_of(const PerBody<Vector3d>& p, const Vector3d& up) {
  std::pair<int, double> lowest{0, p[0].dot(up) - radius_of(0)};
  for (int b = 1; b < kBodies; ++b)
    if (const double height = p[b].dot(up) - radius_of(b); height < lowest.second) lowest = {b, height};
  return lowest;
}

std::vector<double> falls_along(const RoughBody& body, const std::vector<double>& lowest,
                                const Vector3d& up) {
  constexpr int kShortest = 5;
  constexpr double kClear = 0.05, kLeastBend = 0.02, kResidual = 0.012, kAligned = 0.95, kWhole = 0.5;
  const double floor = quantile(lowest, 0.05);
  const int frames = body.p.count();
  std::vector<double> falls;
  for (int first = 0; first < frames;) {
    int end = first;
    while (end < frames && lowest[static_cast<std::size_t>(end)] > floor + kClear) ++end;
    const int n = end - first;
    if (n >= kShortest && n < frames / 2) {
      double residual = 0.0, of_pelvis = 0.0, of_chest = 0.0;
      const Vector3d bend = curvature_of(
          n, [&](int i) { return body.center[first + i]; }, residual);
      // The whole body bends, not an arm or a leg that swings.
      const double pelvis = -curvature_of(
                                 n, [&](int i) { return body.p[first + i][kPelvis]; }, of_pelvis)
                                 .dot(up),
                   chest = -curvature_of(
                                n, [&](int i) { return body.p[first + i][kSpine3]; }, of_chest)
                                .dot(up);
      if (bend.norm() > kLeastBend && residual < kResidual && -bend.normalized().dot(up) > kAligned &&
          std::min(pelvis, chest) > kWhole * bend.norm())
        falls.push_back(8.0 * bend.norm() / (n * n));
    }
    first = std::max(end, first + 1);
  }
  return falls;
}

std::vector<double> falls_along(const PerFrame<Landmarks>& poses, const Vector3d& up) {
  const RoughBody body = rough_body_of(poses);
  std::vector<double> lowest;
  for (const auto& p : body.p) lowest.push_back(lowest_of(p, up).second);
  return falls_along(body, lowest, up);
}

}  // namespace mimicx::import
