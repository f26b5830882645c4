/// Numbers as text that a page decodes in a line: base64 digits, the highest first.
///
/// A number n of d digits is written as n + 2^(6d − 1): two digits reach ±2048, three ±131072.
#pragma once

#include <limits>
#include <string>

namespace mimicx::report {

/// Where a curve has no value: a gap in the chart.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

class Digits {
 public:
  /// The nearest whole number; what is too large is the largest there is.
  void put(double value, int digits);
  /// A number that is never negative, as it is: one digit reaches 63, two 4095. What is larger is the
  /// largest.
  void put_count(double value, int digits);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// To so many steps per unit (10000: four decimals): shorter in a page, and nobody sees the rest.
double rounded(double value, double per_unit);

}  // namespace mimicx::report
