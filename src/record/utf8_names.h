/// File names may be any bytes, but JSON holds only UTF-8: a reversible encoding of names.
#pragma once

#include <string>

namespace mimicx::record {

/// The name as valid UTF-8: an invalid byte becomes the code point U+EF00 + byte, of the private use area.
std::string to_utf8(const std::string& name);
/// The name that `to_utf8` was given.
std::string from_utf8(const std::string& text);

}  // namespace mimicx::record
