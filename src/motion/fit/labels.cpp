/// Left and right in order, and feet that stand: what the keypoint fit decides anew before each step.
#include <algorithm>
#include <cmath>

#include "motion/fit/problem.h"

namespace mimicx {
namespace {

constexpr double kFar = 0.15;        ///< heights of the box: farther detections count no more than this
constexpr double kBetter = 0.4;      ///< a swap must lower a limb's cost to this share …
constexpr double kFarEnough = 0.03;  ///< … and its points must be so far off on average, heights of the box

constexpr double kLabelSpeed = 0.3;                             ///< m/s over five frames at 30 fps
constexpr double kLabelHeight = 0.03, kUnsettledHeight = 0.05;  ///< m
constexpr double kLabelLowShare = 0.1;
constexpr double kSpeedWindow = 2.0 / 30.0;  ///< s to either side

bool is_leg(int body) {
  return body == kLeftHip || body == kRightHip || body == kLeftKnee || body == kRightKnee ||
         body == kLeftAnkle || body == kRightAnkle || body == kLeftFoot || body == kRightFoot;
}

/// Mean offset of the detections from the prediction, which no swap changes.
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

/// Whether the legs (or arms) of a frame fit the prediction much better with left and right exchanged.
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
      return confidence * std::pow(std::min(distance, kFar), 2);
    };
    keep += cost(k);
    swapped += cost(m);
    weight += confidence;
  }
  return weight > 0.0 && swapped < kBetter * keep && keep > weight * kFarEnough * kFarEnough;
}

}  // namespace

int order_labels(const std::vector<std::vector<Vector3d>>& detected,
                 const std::vector<std::vector<Eigen::Vector2d>>& predicted, FitProblem& problem) {
  int frames = 0;
  problem.uvc = detected;
  for (std::size_t t = 0; t < detected.size(); ++t) {
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

Contacts find_contacts(const std::vector<FootPositions>& feet, double fps, bool settled) {
  Contacts contacts(feet.size());
  const std::size_t last = feet.size() - 1;
  const auto window = static_cast<std::size_t>(std::max(1.0, std::round(kSpeedWindow * fps)));
  for (std::size_t foot = 0; foot < 2; ++foot) {
    const std::size_t first = foot * kFootPoints / 2, end = first + kFootPoints / 2;
    double floor = 0.0;
    if (!settled) {
      std::vector<double> lowest;
      for (const FootPositions& p : feet) {
        double z = p[first].z();
        for (std::size_t i = first; i < end; ++i) z = std::min(z, p[i].z());
        lowest.push_back(z);
      }
      const auto low =
          lowest.begin() + static_cast<std::ptrdiff_t>(kLabelLowShare * static_cast<double>(lowest.size()));
      std::nth_element(lowest.begin(), low, lowest.end());
      floor = *low;
    }
    const double ceiling = floor + (settled ? kLabelHeight : kUnsettledHeight);
    for (std::size_t t = 0; t < feet.size(); ++t) {
      const std::size_t before = t > window ? t - window : 0, after = std::min(t + window, last);
      for (std::size_t i = first; i < end; ++i) {
        const double speed =
            (feet[after][i] - feet[before][i]).norm() * fps / static_cast<double>(after - before);
        contacts[t][i] = feet[t][i].z() < ceiling && speed < kLabelSpeed;
      }
    }
  }
  return contacts;
}

}  // namespace mimicx
