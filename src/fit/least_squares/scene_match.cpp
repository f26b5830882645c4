#include "fit/least_squares/scene_match.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/quantile.h"

namespace mimicx::fit {
namespace {

constexpr double kSlow = 0.3;                   // m/s
constexpr double kSlowWindow = 0.07;            // to either side, s
constexpr double kFarthest = 0.6;               // m
constexpr double kCoarse = 0.03, kFine = 0.01;  // steps of the search, m
constexpr double kOutlier = 0.1;                // m
constexpr double kPerShift = 1e-3;              // squared distance per squared shift
constexpr int kEvery = 3;                       // frames

/// Height over the scene, m; nobody stands inside a box, so depth has no limit.
double height_over(const Scene& scene, const Vector3d& p) { return p.z() - scene.height_under(p, HUGE_VAL); }

}  // namespace

Eigen::Vector2d scene_shift(const PerFrame<FootPositions>& feet, double fps, const Scene& scene,
                            bool settled) {
  if (scene.flat()) return Eigen::Vector2d::Zero();
  std::vector<Vector3d> slow;
  const int last = feet.count() - 1, window = std::max(1, static_cast<int>(std::lround(kSlowWindow * fps)));
  for (int t = 0; t <= last; t += kEvery) {
    const int before = std::max(t - window, 0), after = std::min(t + window, last);
    for (int i = 0; i < kFootPoints; ++i)
      if ((feet[after][i] - feet[before][i]).norm() * fps < kSlow * (after - before))
        slow.push_back(feet[t][i]);
  }
  if (slow.empty()) return Eigen::Vector2d::Zero();
  const auto cost = [&](const Eigen::Vector2d& shift) {
    std::vector<double> heights;
    for (const Vector3d& p : slow)
      heights.push_back(height_over(scene, p - Vector3d(shift.x(), shift.y(), 0.0)));
    const double common = settled ? 0.0 : median(heights);
    double sum = kPerShift * static_cast<double>(slow.size()) * shift.squaredNorm();
    for (const double height : heights) sum += square(std::min(std::abs(height - common), kOutlier));
    return sum;
  };
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double least = cost(best);
  const auto search = [&](double step, int steps) {
    const Eigen::Vector2d centre = best;
    for (int i = -steps; i <= steps; ++i)
      for (int j = -steps; j <= steps; ++j) {
        const Eigen::Vector2d shift = centre + step * Eigen::Vector2d(i, j);
        if (const double now = cost(shift); now < least) least = now, best = shift;
      }
  };
  search(kCoarse, static_cast<int>(std::lround(kFarthest / kCoarse)));
  search(kFine, 2);
  return best;
}

Scene shifted(Scene scene, const Eigen::Vector2d& shift) {
  for (Plate& plate : scene.plates) plate.centre += shift;
  return scene;
}

}  // namespace mimicx::fit
