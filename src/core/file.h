/// Reading and writing a whole file, with a message that says what is in the way.
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

/// Writes text or bytes to a temporary name beside `path` and renames it: a reader sees the old file or the
/// new one, whole.
/// @throws DataError when `path` cannot be written; the temporary file is gone then
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace mimicx
