/// File names are bytes; JSON holds UTF-8 alone. Any name goes into a record and comes back as it was.
#pragma once

#include <string>

namespace mimicx::record {

/// Valid UTF-8: a byte that is none becomes the code point U+EF00 + byte, of the private use area.
std::string to_utf8(const std::string& name);
/// The name that `to_utf8` was given.
std::string from_utf8(const std::string& text);

}  // namespace mimicx::record
