/// One process per folder: while one writes to it, any other is refused with an error of one line.
///
/// The operating system releases the lock when the process ends, also after a crash. Locking the folder
/// itself leaves no file behind, but on a network file system it holds on one machine only; a lock of a file
/// in the folder holds wherever the file system's flock does. The shards of a run (shard.h) share the lock of
/// the whole run.
#pragma once

#include <filesystem>
#include <string>

namespace mimicx::record {

enum class Hold { kAlone, kShared };  ///< shared: several holders at once

class FolderLock {
 public:
  /// Creates the folder if it is missing.
  /// @param file  the file in it to lock, created if missing; empty: the folder itself
  /// @throws OutputRefused if another process holds the lock, DataError if folder or file cannot be created
  explicit FolderLock(const std::filesystem::path& folder, Hold hold = Hold::kAlone,
                      const std::string& file = {});
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};

}  // namespace mimicx::record
