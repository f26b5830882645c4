#include "motion/prepare/floor_correction.h"

#include <algorithm>
#include <cmath>

#include "motion/prepare/sliding_window.h"

namespace mimicx::motion {
namespace {

/// Share of the heights of the lowest point that lies below the support.
constexpr double kSupportShare = 0.25;
constexpr double kSupportWindow = 1.2;         ///< s
constexpr double kSupportSmoothing = 0.3;      ///< s, standard deviation
constexpr double kMaxDrift = 0.15;             ///< m
constexpr double kPenetrationAllowed = 0.010;  ///< m
constexpr double kLiftRadius = 1.0 / 15.0;     ///< s

/// A smooth curve nowhere under `need`: the maximum over twice the radius, averaged twice over the radius.
PerFrame<double> smooth_cover(const PerFrame<double>& need, double fps) {
  const int radius = static_cast<int>(std::lround(kLiftRadius * fps));
  const auto highest = [](const std::vector<double>& w) { return *std::max_element(w.begin(), w.end()); };
  const auto mean = [](const std::vector<double>& w) {
    double sum = 0.0;
    for (const double v : w) sum += v;
    return sum / static_cast<double>(w.size());
  };
  return sliding(sliding(sliding(need, 2 * radius, highest), radius, mean), radius, mean);
}

}  // namespace

PerFrame<double> lift_over_floor(const PerFrame<double>& lowest, double fps) {
  PerFrame<double> need;
  for (double z : lowest) need.push_back(std::max(0.0, -z - kPenetrationAllowed));
  return smooth_cover(need, fps);
}

FloorCorrection floor_correction(const PerFrame<double>& lowest, const PerFrame<double>& lifted, double fps,
                                 bool known) {
  FloorCorrection out;
  out.shift = known ? 0.0 : -nearest_rank(lowest, kSupportShare);
  const int radius = static_cast<int>(0.5 * kSupportWindow * fps);
  PerFrame<double> drift = sliding(lowest, radius, [&](const std::vector<double>& w) {
    return std::clamp(-nearest_rank(w, kSupportShare) - out.shift, -kMaxDrift, kMaxDrift);
  });
  drift = smoothed(drift, kSupportSmoothing * fps);
  PerFrame<double> moved;
  for (int t = 0; t < lowest.count(); ++t) moved.push_back(lifted[t] + out.shift + drift[t]);
  const PerFrame<double> lift = lift_over_floor(moved, fps);
  for (int t = 0; t < lowest.count(); ++t) out.height.push_back(out.shift + drift[t] + lift[t]);
  return out;
}

}  // namespace mimicx::motion
