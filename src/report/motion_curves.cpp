#include "report/motion_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "audit/slip.h"
#include "core/units.h"
#include "report/base64_digits.h"

namespace mimicx::report {
namespace {

constexpr double kShake = 2.0;  ///< m/s²

using Points = std::vector<Vector3d>;

}  // namespace

MotionCurves curves_of(const motion::MotionSamples& motion) {
  MotionCurves curves;
  const int frames = motion.frames();
  for (int t = 0; t < frames; ++t) {
    const Points& now = motion.surface[t];
    curves.pelvis_height.push_back(motion.joints[t][kPelvis].z());
    curves.lowest.push_back(kMm * motion::lowest_height(now, motion.scene));
    double acceleration = t > 0 && t + 1 < frames ? 0.0 : kNoValue;
    for (int j = 0; j < kBodies && !std::isnan(acceleration); ++j)
      acceleration +=
          (motion.joints[t + 1][j] - 2.0 * motion.joints[t][j] + motion.joints[t - 1][j]).norm() / kBodies;
    curves.acceleration.push_back(acceleration * motion.fps * motion.fps);
  }
  return curves;
}

MeasuredMotion measured(motion::MotionSamples samples, std::vector<double> slip) {
  MotionCurves curves = curves_of(samples);
  curves.slip = std::move(slip);
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
    flaws.slides.push_back(its.slip[k] > audit::kVisibleSlip);                     // never of NaN
    flaws.shakes.push_back(its.acceleration[k] - good.acceleration[k] >= kShake);  // never of NaN
  }
  return flaws;
}

}  // namespace mimicx::report
