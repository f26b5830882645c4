#include "audit/chatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/elementary.h"

namespace mimicx::audit {
namespace {

constexpr double kCutoff = 6.0;        ///< Hz; of forces on plates in walking nearly nothing is faster
constexpr double kBeyondEnds = 0.5;    ///< s
constexpr double kShortest = 1.0 / 3;  ///< s

/// Second order, (5); starts as if the first value had always been there.
void filter(List<double>& signal, double fps, double cutoff) {
  const double r = tan(std::numbers::pi * cutoff / fps), q = std::numbers::sqrt2 * r, a0 = 1.0 + q + r * r;
  const double b = r * r / a0, a1 = 2.0 * (r * r - 1.0) / a0, a2 = (1.0 - q + r * r) / a0;
  double x1 = signal.front(), x2 = x1, y1 = x1, y2 = x1;
  for (double& x : signal) {
    const double y = b * (x + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1, x1 = x, y2 = y1, y1 = y;
    x = y;
  }
}

}  // namespace

List<double> low_passed(const List<double>& signal, double fps, double cutoff) {
  if (!(cutoff > 0.0 && 2.0 * cutoff < fps))
    throw std::invalid_argument("low_passed: a cutoff between 0 and half the rate is needed");
  if (signal.empty()) return signal;
  const int n = signal.count(), beyond = std::min(n - 1, static_cast<int>(std::lround(kBeyondEnds * fps)));
  List<double> longer;
  for (int k = beyond; k > 0; --k) longer.push_back(2.0 * signal.front() - signal[k]);
  longer.insert(longer.end(), signal.begin(), signal.end());
  for (int k = 1; k <= beyond; ++k) longer.push_back(2.0 * signal.back() - signal[n - 1 - k]);
  for (int way = 0; way < 2; ++way) {
    filter(longer, fps, cutoff);
    std::reverse(longer.begin(), longer.end());
  }
  return std::vector<double>(longer.begin() + beyond, longer.begin() + beyond + n);
}

double chatter_of(const List<double>& vertical, double weight, double fps) {
  if (!(vertical.count() >= kShortest * fps && 2.0 * kCutoff < fps))
    return std::numeric_limits<double>::quiet_NaN();
  const List<double> smooth = low_passed(vertical, fps, kCutoff);
  double sum = 0.0;
  for (int t = 0; t < vertical.count(); ++t) sum += (vertical[t] - smooth[t]) * (vertical[t] - smooth[t]);
  return 100.0 / weight * std::sqrt(sum / vertical.count());
}

}  // namespace mimicx::audit
