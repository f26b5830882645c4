/// Numbers as text, independent of the locale: the decimal separator is always a point.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mimicx {

/// The double nearest to a decimal number, "inf" or "nan". None unless the whole text is such a number; none
/// also for a leading "+" or space, a hexadecimal form, and numbers too large for a double. Numbers too near
/// to 0 become it, or a subnormal.
std::optional<double> number_from(std::string_view text);

/// The fewest digits that read back as the same number.
std::string text_of(double value);

/// What printf writes, of any length.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// "1 frame", "2 frames": a number of things, of which a regular noun in the singular names one.
std::string counted(long long number, std::string_view thing);

/// The text, padded with blanks at its end to at least `width` characters.
std::string padded(std::string text, std::size_t width);

}  // namespace mimicx
