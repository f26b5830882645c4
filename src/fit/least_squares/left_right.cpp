#include "fit/least_squares/left_right.h"

#include <algorithm>

#include "core/elementary.h"

namespace mimicx::fit {
namespace {

constexpr double kFar = 0.15;        ///< heights of the box; cap of a distance in the cost
constexpr double kBetter = 0.4;      ///< a swap must reduce a limb's cost to this share …
constexpr double kFarEnough = 0.03;  ///< … and its mean distance must be above this, heights of the box

bool is_leg(int body) { return kLimbOf[body] == 1 || kLimbOf[body] == 2; }

/// Mean offset of the detections from the prediction. Swaps do not change it.
Eigen::Vector2d mean_offset(const std::vector<Vector3d>& detected,
                            const std::vector<Eigen::Vector2d>& predicted,
                            const std::vector<FitPoint>& points) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (detected[k].z() <= 0.0 || detected[points[k].mirror].z() <= 0.0) continue;
    sum += detected[k].head<2>() - predicted[k];
    ++count;
  }
  return count ? Eigen::Vector2d(sum / count) : sum;
}

/// Whether the legs (or arms) of a frame fit the prediction much better after exchanging left and right.
bool prefers_swap(const std::vector<Vector3d>& detected, const std::vector<Eigen::Vector2d>& predicted,
                  const std::vector<FitPoint>& points, bool legs, double box) {
  const Eigen::Vector2d offset = mean_offset(detected, predicted, points);
  double keep = 0.0, swapped = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t m = points[k].mirror;
    if (m == k || is_leg(points[k].body) != legs) continue;
    const double confidence = std::min(detected[k].z(), detected[m].z());  // both must be seen
    const auto cost = [&](std::size_t from) {
      const double distance = (detected[from].head<2>() - predicted[k] - offset).norm() / box;
      return confidence * pow(std::min(distance, kFar), 2);
    };
    keep += cost(k);
    swapped += cost(m);
    weight += confidence;
  }
  return weight > 0.0 && swapped < kBetter * keep && keep > weight * kFarEnough * kFarEnough;
}

}  // namespace

int order_left_and_right(const PerFrame<std::vector<Vector3d>>& detected,
                         const PerFrame<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem) {
  int frames = 0;
  problem.uvc = detected;
  for (int t = 0; t < detected.count(); ++t) {
    if (problem.box[t] <= 0.0) continue;
    bool any = false;
    for (bool legs : {true, false}) {
      if (!prefers_swap(detected[t], predicted[t], problem.points, legs, problem.box[t])) continue;
      any = true;
      for (std::size_t k = 0; k < problem.points.size(); ++k)
        if (is_leg(problem.points[k].body) == legs) problem.uvc[t][k] = detected[t][problem.points[k].mirror];
    }
    frames += any ? 1 : 0;
  }
  return frames;
}

}  // namespace mimicx::fit
