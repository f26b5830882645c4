#include "report/base64_digits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace mimicx::report {

void Digits::put(double value, int digits) {
  const double half = std::ldexp(1.0, 6 * digits - 1);
  put_count(std::max(std::round(value), -half) + half, digits);
}

void Digits::put_count(double value, int digits) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const double most = std::ldexp(1.0, 6 * digits) - 1.0;
  const auto number = static_cast<std::uint32_t>(std::clamp(std::round(value), 0.0, most));
  for (int k = digits - 1; k >= 0; --k) text_ += kDigits[number >> (6 * k) & 63];
}

double rounded(double value, double per_unit) { return std::round(per_unit * value) / per_unit; }

}  // namespace mimicx::report
