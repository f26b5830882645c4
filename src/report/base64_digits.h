/// Numbers as base64 digits, the highest first: short text that the page decodes.
///
/// A number n of d digits is written as n + 2^(6d − 1): two digits reach ±2048, three ±131072.
#pragma once

#include <limits>
#include <string>

namespace mimicx::report {

/// A missing value of a curve: a gap in the chart.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

class Digits {
 public:
  /// Adds the nearest whole number, clamped to the range of the digits.
  void put(double value, int digits);
  /// Adds a number that is never negative, without the offset, clamped: one digit reaches 63, two 4095.
  void put_count(double value, int digits);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The value rounded to `per_unit` steps per unit (10000: four decimals), for a shorter page.
double rounded(double value, double per_unit);

}  // namespace mimicx::report
