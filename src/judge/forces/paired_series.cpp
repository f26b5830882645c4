#include "judge/forces/paired_series.h"

#include <cmath>
#include <limits>

namespace mimicx::judge {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

double spread_of(const Values& values) {
  const double mean = mean_of_values(values);
  Values away;
  for (const double v : values) away.push_back(v - mean);
  return rms_of(away);
}

}  // namespace

double mean_of_values(const Values& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? kNoValue : sum / static_cast<double>(values.size());
}

double rms_of(const Values& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return values.empty() ? kNoValue : std::sqrt(sum / static_cast<double>(values.size()));
}

Values PairedSeries::difference() const {
  Values d;
  for (std::size_t i = 0; i < a.size(); ++i) d.push_back(a[i] - b[i]);
  return d;
}

double PairedSeries::rms() const { return rms_of(difference()); }

double PairedSeries::correlation() const {
  const double sa = spread_of(a), sb = spread_of(b), ma = mean_of_values(a), mb = mean_of_values(b);
  if (a.size() <= 3 || !(sa > 1e-6) || !(sb > 1e-6)) return kNoValue;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - ma) * (b[i] - mb);
  return sum / static_cast<double>(a.size()) / (sa * sb);
}

double time_of_first_frame(double first, double fps) { return std::abs(first) * fps < 1.0 ? 0.0 : first; }

}  // namespace mimicx::judge
