#include "report/motion_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/units.h"
#include "report/base64_digits.h"

namespace mimicx::report {
namespace {

constexpr double kSlide = 5.0;  ///< mm/frame
constexpr double kShake = 2.0;  ///< m/s²

using Points = std::vector<Vector3d>;

/// Mean horizontal displacement of the points first … last − 1 that touch the floor in both frames of
/// `floor`, mm; NaN if none does.
double way(const Points& now, const Points& next, const Points& floor_now, const Points& floor_next,
           std::size_t first, std::size_t last) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = first; i < last; ++i) {
    if (floor_now[i].z() > motion::kContactHeight || floor_next[i].z() > motion::kContactHeight) continue;
    sum += (next[i] - now[i]).head<2>().norm();
    ++count;
  }
  return count == 0 ? kNoValue : kMm * sum / count;
}

/// The larger displacement of the two feet while those of the cleaned motion stand.
double foot_way(const motion::MotionSamples& input, const motion::MotionSamples& cleaned, int t) {
  double most = 0.0;
  for (const std::size_t first : {std::size_t{0}, std::size_t{kFootPoints / 2}}) {
    const double foot = way(input.surface[t], input.surface[t + 1], cleaned.surface[t],
                            cleaned.surface[t + 1], first, first + kFootPoints / 2);
    if (foot > most) most = foot;  // never of NaN
  }
  return most;
}

}  // namespace

MotionCurves curves_of(const motion::MotionSamples& motion) {
  MotionCurves curves;
  const int frames = motion.frames();
  for (int t = 0; t < frames; ++t) {
    const Points& now = motion.surface[t];
    curves.pelvis_height.push_back(motion.joints[t][kPelvis].z());
    curves.lowest.push_back(kMm * motion::lowest_height(now));
    curves.slide.push_back(t + 1 < frames
                               ? way(now, motion.surface[t + 1], now, motion.surface[t + 1], 0, now.size())
                               : kNoValue);
    double acceleration = t > 0 && t + 1 < frames ? 0.0 : kNoValue;
    for (int j = 0; j < kBodies && !std::isnan(acceleration); ++j)
      acceleration +=
          (motion.joints[t + 1][j] - 2.0 * motion.joints[t][j] + motion.joints[t - 1][j]).norm() / kBodies;
    curves.acceleration.push_back(acceleration * motion.fps * motion.fps);
  }
  return curves;
}

MeasuredMotion measured(motion::MotionSamples samples) {
  MotionCurves curves = curves_of(samples);
  return {std::move(samples), std::move(curves)};
}

std::vector<double> joint_distances(const motion::MotionSamples& a, const motion::MotionSamples& b) {
  std::vector<double> means(static_cast<std::size_t>(std::min(a.frames(), b.frames())));
  for (std::size_t t = 0; t < means.size(); ++t)
    for (int j = 0; j < kBodies; ++j) means[t] += kMm * (a.joints[t][j] - b.joints[t][j]).norm() / kBodies;
  return means;
}

std::vector<Span> spans_of(const std::vector<bool>& frames) {
  std::vector<Span> spans;
  for (int t = 0; t < static_cast<int>(frames.size()); ++t) {
    if (!frames[static_cast<std::size_t>(t)]) continue;
    if (!spans.empty() && spans.back().last == t - 1)
      spans.back().last = t;
    else
      spans.push_back({t, t});
  }
  return spans;
}

Flaws flaws_of(const MeasuredMotion& input, const MeasuredMotion& cleaned) {
  const MotionCurves &its = input.curves, &good = cleaned.curves;
  const int frames = std::min(input.samples.frames(), cleaned.samples.frames());
  Flaws flaws;
  for (int t = 0; t < frames; ++t) {
    const auto k = static_cast<std::size_t>(t);
    flaws.sinks.push_back(its.lowest[k] < -kMm * motion::kContactHeight);
    flaws.floats.push_back(its.lowest[k] > kMm * motion::kContactHeight &&
                           good.lowest[k] <= kMm * motion::kContactHeight);
    flaws.slides.push_back(t + 1 < frames && foot_way(input.samples, cleaned.samples, t) >= kSlide);
    flaws.shakes.push_back(its.acceleration[k] - good.acceleration[k] >= kShake);  // never of NaN
  }
  return flaws;
}

}  // namespace mimicx::report
