#include "command_line_numbers.h"

#include <charconv>
#include <cmath>

namespace mimicx::tools {
namespace {

template <class T>
std::optional<T> parsed(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end) return std::nullopt;
  return value;
}

/// The largest range in which every whole number is a double.
constexpr double kExact = 9007199254740992.0;  // 2⁵³

template <class T>
std::optional<T> whole(const std::string& text) {
  if (const std::optional<T> digits = parsed<T>(text)) return digits;
  const std::optional<double> number = number_of(text);
  if (!number || std::trunc(*number) != *number || std::abs(*number) > kExact) return std::nullopt;
  if (*number < 0.0 && !std::is_signed_v<T>) return std::nullopt;
  return static_cast<T>(*number);
}

}  // namespace

std::optional<double> number_of(const std::string& text) {
  double factor = 1.0;
  std::string digits = text;
  if (!digits.empty() && (digits.back() == 'k' || digits.back() == 'M')) {
    factor = digits.back() == 'k' ? 1e3 : 1e6;
    digits.pop_back();
  }
  const std::optional<double> number = parsed<double>(digits);
  if (!number || !std::isfinite(*number * factor)) return std::nullopt;
  return *number * factor;
}

std::optional<std::int64_t> whole_number_of(const std::string& text) { return whole<std::int64_t>(text); }
std::optional<std::uint64_t> natural_number_of(const std::string& text) { return whole<std::uint64_t>(text); }

}  // namespace mimicx::tools
