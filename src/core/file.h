/// Reading a whole file, with a message that says what is in the way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/error.h"

namespace mimicx {

inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 32;

/// The bytes of a regular file.
/// @throws DataError when there is none, it is a folder or a device, may not be read, or is larger than
///         `max_bytes` (nothing is read then)
std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes = kMaxFileBytes);

}  // namespace mimicx
