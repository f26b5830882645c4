/// Reading and writing a whole file, with a message that says what is in the way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"

namespace mimicx {

inline constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 32;

/// The bytes of a regular file.
/// @throws DataError when there is none, it is a folder or a device, may not be read, or is larger than
///         `max_bytes` (nothing is read then)
std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes = kMaxFileBytes);

/// Makes a folder and those around it, where they are not there. @throws DataError when it cannot
void make_folder(const std::filesystem::path& path);

/// A file that grows under a temporary name beside `path` and gets its name when it is whole: a reader sees
/// the old file or the new one. Without `finish` the temporary file is gone with the object.
class AtomicFile {
 public:
  /// @throws DataError when `path` cannot be written
  explicit AtomicFile(const std::filesystem::path& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(std::string_view content);
  /// @throws DataError when anything could not be written; the temporary file is gone then
  void finish();

 private:
  std::filesystem::path path_, temporary_;
  std::ofstream out_;
};

/// Writes text or bytes by an AtomicFile.
/// @throws DataError when `path` cannot be written; the temporary file is gone then
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace mimicx
