#include "core/number_text.h"

#include <locale.h>  // uselocale: POSIX

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <version>

namespace mimicx {

#ifdef __cpp_lib_to_chars
std::optional<double> number_from(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error ==
      std::errc::result_out_of_range) {  // too far from 0, or too near to it: from_chars does not tell
    value = std::strtod(std::string(text).c_str(), nullptr);
    return std::isinf(value) ? std::nullopt : std::optional(value);
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::string text_of(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

#else  // std::from_chars of this library has integers only; its programs stay in the locale "C"

std::optional<double> number_from(std::string_view text) {
  const std::string copy(text);
  if (copy.empty() || copy.find_first_of("+ \t\n\v\f\r") == 0 ||
      copy.find_first_of("xX") != std::string::npos)
    return std::nullopt;
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(copy.c_str(), &end);
  const bool too_far = errno == ERANGE && std::isinf(value);
  if (too_far || end != copy.c_str() + copy.size()) return std::nullopt;
  return value;
}

std::string text_of(double value) {
  char buffer[40];
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
    if (std::strtod(buffer, nullptr) == value) break;
  }
  return buffer;
}

#endif

namespace {

/// Puts this thread into the locale "C": a host of the library may be in one with a decimal comma.
class PlainLocale {
#ifndef MIMICX_BARE  // which has no other locale
 public:
  PlainLocale() : before_(uselocale(plain())) {}
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  static locale_t plain() {
    static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
    return locale;
  }
  locale_t before_;
#endif
};

}  // namespace

std::string formatted(const char* format, ...) {
  [[maybe_unused]] const PlainLocale plain;
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  char shorter[256];  // tables of numbers need no second pass
  const auto length = static_cast<std::size_t>(std::vsnprintf(shorter, sizeof shorter, format, values));
  std::string text(shorter, std::min(length, sizeof shorter - 1));
  if (length >= sizeof shorter) {
    text.resize(length);
    std::vsnprintf(text.data(), length + 1, format, again);
  }
  va_end(again);
  va_end(values);
  return text;
}

std::string counted(long long number, std::string_view thing) {
  return std::to_string(number) + ' ' + std::string(thing) + (number == 1 ? "" : "s");
}

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

}  // namespace mimicx
