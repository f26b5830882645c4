#include "synth/min_jerk_track.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/elementary.h"

namespace mimicx::synth {

MinJerkTrack::MinJerkTrack(std::vector<Knot> knots) : knots_(std::move(knots)) {
  if (knots_.empty()) throw std::invalid_argument("MinJerkTrack: at least one knot is needed");
  std::stable_sort(knots_.begin(), knots_.end(),
                   [](const Knot& a, const Knot& b) { return a.time < b.time; });
  for (std::size_t i = 1; i < knots_.size(); ++i)
    if (!(knots_[i].time > knots_[i - 1].time))
      throw std::invalid_argument("MinJerkTrack: two knots share a time");
}

double MinJerkTrack::at(double time) const {
  if (time <= knots_.front().time) return knots_.front().value;
  if (time >= knots_.back().time) return knots_.back().value;
  const auto next = std::upper_bound(knots_.begin(), knots_.end(), time,
                                     [](double t, const Knot& knot) { return t < knot.time; });
  const Knot& a = *(next - 1);
  const Knot& b = *next;
  // In s = (t − a)/T the start fixes the first three coefficients; the end gives a 3 × 3 system whose
  // solution is written out.
  const double T = b.time - a.time, s = (time - a.time) / T;
  const double v0 = a.velocity * T, v1 = b.velocity * T;
  const double a0 = a.acceleration * T * T, a1 = b.acceleration * T * T;
  const double rise = b.value - a.value;
  const double c3 = 10.0 * rise - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1;
  const double c4 = -15.0 * rise + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1;
  const double c5 = 6.0 * rise - 3.0 * (v0 + v1) - 0.5 * (a0 - a1);
  return a.value + s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5))));
}

PerFrame<double> smoothed(const PerFrame<double>& values, double sigma) {
  const int last = values.count() - 1, radius = static_cast<int>(std::ceil(4.0 * sigma));
  PerFrame<double> out(values.size());
  for (int i = 0; i <= last; ++i) {
    double sum = 0.0, weights = 0.0;
    for (int k = -radius; k <= radius; ++k) {
      const double weight = exp(-0.5 * k * k / (sigma * sigma));
      sum += weight * values[std::clamp(i + k, 0, last)];
      weights += weight;
    }
    out[i] = sum / weights;
  }
  return out;
}

}  // namespace mimicx::synth
