/// One process per folder: while one writes to it, another is refused in one line.
///
/// The system lets go of the lock when the process ends, however it ends. A folder's own lock leaves nothing
/// behind, but over a network file system it holds on one machine alone; the lock of a file in the folder
/// holds as far as that file system's flock does. The parts of a run (shard.h) share the lock of the whole.
#pragma once

#include <filesystem>
#include <string>

namespace mimicx::record {

enum class Hold { kAlone, kShared };  ///< shared: with all others that share it

class FolderLock {
 public:
  /// Makes the folder where it is not there.
  /// @param file  a file in it that has the lock, made where it is not there; empty: the folder itself
  /// @throws OutputRefused where another process holds the lock, DataError where folder or file cannot be
  /// made
  explicit FolderLock(const std::filesystem::path& folder, Hold hold = Hold::kAlone,
                      const std::string& file = {});
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};

}  // namespace mimicx::record
