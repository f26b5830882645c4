#include "motion/prepare/ground_slope.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"
#include "motion/prepare/stance.h"

namespace mimicx::motion {
namespace {

constexpr double kStillSole = 0.3;  ///< m/s
constexpr int kFewestStanding = 10;
constexpr double kSmallestSlope = 10.0 * kDegree, kLargestSlope = 60.0 * kDegree,
                 kLargestSpread = 30.0 * kDegree;

/// Of the feet that stand, over all frames; directions are sums of unit vectors.
struct StandingFeet {
  std::vector<Vector3d> points;  ///< of their soles, m
  Vector3d normal = Vector3d::Zero(), balance = Vector3d::Zero();
  int frames = 0;
};

double fastest(const PerFrame<SolePositions>& p, int t, int first, double fps) {
  const int before = std::max(t - 1, 0), after = std::min(t + 1, p.count() - 1);
  double farthest = 0.0;
  for (int k = first; k < first + kPointsPerFoot; ++k)
    farthest = std::max(farthest, (p[after][k] - p[before][k]).norm());
  return farthest * fps / std::max(after - before, 1);
}

StandingFeet standing_feet(const Character& character, const PerFrame<BodyPoses>& poses, double fps) {
  PerFrame<SolePositions> p;
  for (const BodyPoses& frame : poses) p.push_back(sole_positions(character, frame));
  StandingFeet out;
  for (int t = 0; t < p.count(); ++t) {
    Vector3d sum = Vector3d::Zero();
    int points = 0;
    for (int first = 0; first < kFootPoints; first += kPointsPerFoot) {
      if (fastest(p, t, first, fps) > kStillSole) continue;
      for (int k = first; k < first + kPointsPerFoot; ++k, ++points) {
        out.points.push_back(p[t][k]);
        sum += p[t][k];
      }
      out.normal += poses[t].q_WB[first == 0 ? kLeftAnkle : kRightAnkle] * Vector3d::UnitY();
    }
    if (points == 0) continue;
    ++out.frames;
    out.balance += (center_of_mass(character, poses[t]) - sum / points).normalized();
  }
  return out;
}

/// Normal of the plane with the least squares of distances from the points.
Vector3d normal_of_plane(const std::vector<Vector3d>& points) {
  const double share = 1.0 / static_cast<double>(points.size());
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += share * p;
  Matrix3d squares = Matrix3d::Zero();
  for (const Vector3d& p : points) squares += share * (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(squares).eigenvectors().col(0);
}

}  // namespace

std::optional<GroundSlope> ground_slope(const Character& character, const PerFrame<BodyPoses>& poses,
                                        double fps) {
  const StandingFeet feet = standing_feet(character, poses, fps);
  if (feet.frames < kFewestStanding) return std::nullopt;
  std::array<Vector3d, 3> directions = {normal_of_plane(feet.points), feet.normal.normalized(),
                                        feet.balance.normalized()};
  if (directions[0].dot(directions[1]) < 0.0) directions[0] = -directions[0];
  GroundSlope out;
  out.up = (directions[0] + directions[1] + directions[2]).normalized();
  const Vector3d downhill = Vector3d(out.up.x(), out.up.y(), 0.0).normalized();
  std::array<double, 3> angles{};
  for (std::size_t i = 0; i < angles.size(); ++i)
    angles[i] = atan2(directions[i].dot(downhill), directions[i].z());
  std::sort(angles.begin(), angles.end());
  if (angles[0] < kSmallestSlope || angles[1] > kLargestSlope || angles[2] - angles[0] > kLargestSpread)
    return std::nullopt;
  out.degrees = angles[1] / kDegree;
  return out;
}

}  // namespace mimicx::motion
