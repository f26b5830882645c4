/// Reads the digits of a page's data, independent of what wrote them.
#pragma once

#include <stdexcept>
#include <string>

namespace mimicx::report {

/// The base64 digits from `at` on as a number that is never negative.
inline int count_at(const std::string& text, std::size_t at, int digits) {
  const std::string order = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  int number = 0;
  for (int d = 0; d < digits; ++d) {
    const std::size_t value = order.find(text.at(at + static_cast<std::size_t>(d)));
    if (value == std::string::npos) throw std::invalid_argument("no base64 digit: " + text.substr(at, 1));
    number = 64 * number + static_cast<int>(value);
  }
  return number;
}

/// The same of a number that may be negative.
inline int number_at(const std::string& text, std::size_t at, int digits) {
  int range = 1;
  for (int d = 0; d < digits; ++d) range *= 64;
  return count_at(text, at, digits) - range / 2;
}

}  // namespace mimicx::report
