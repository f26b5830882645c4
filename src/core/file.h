/// Reads and writes whole files; errors state the reason.
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
/// @throws DataError if it does not exist, is a folder or a device, cannot be read, or is larger than
///         `max_bytes` (nothing is read in that case)
std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes = kMaxFileBytes);

/// `count` bytes of a regular file from byte `at` on, or as many as it has; none of anything else.
std::string read_bytes(const std::filesystem::path& path, std::size_t at, std::size_t count);

/// Whether a path is that of a folder, or below it, however both are spelled and whatever links lead there.
/// Neither need exist.
bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Creates a folder and its missing parents. @throws DataError if that fails
void make_folder(const std::filesystem::path& path);

/// A file that is written under a temporary name beside `path` and renamed when it is complete: a reader sees
/// either the old file or the new one. Without `finish` the destructor removes the temporary file. Two
/// programs that write the same file use different temporary names: the later one's file stays, whole.
class AtomicFile {
 public:
  /// @throws DataError when `path` cannot be written
  explicit AtomicFile(const std::filesystem::path& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  void write(std::string_view content);
  /// @throws DataError if anything could not be written; the temporary file is removed
  void finish();

 private:
  std::filesystem::path path_, temporary_;
  std::string name_;  ///< of the temporary file, for `remove_unfinished_files`
  std::ofstream out_;
};

/// Removes the temporary files of all AtomicFiles that are being written. Only for the handler of a signal
/// that then ends the program: it takes no lock and no memory.
void remove_unfinished_files();

/// Writes text or bytes by an AtomicFile.
/// @throws DataError if `path` cannot be written; the temporary file is removed
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

}  // namespace mimicx
