/// SHA-256 of bytes (NIST FIPS 180-4).
#pragma once

#include <string>
#include <string_view>

namespace mimicx::audit {

/// 32 bytes.
std::string sha256(std::string_view bytes);

}  // namespace mimicx::audit
