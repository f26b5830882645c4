/// Numbers as text, in no locale: a point for decimals, whatever the user's language.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mimicx {

/// The double nearest to a decimal number, "inf" or "nan"; none unless the whole text is one, without a sign
/// "+", space before it, or a hexadecimal form, and also where no double is near.
std::optional<double> number_from(std::string_view text);

/// The fewest digits that read back as the same number.
std::string text_of(double value);

/// A text with blanks behind it, at least `width` characters.
std::string padded(std::string text, std::size_t width);

}  // namespace mimicx
