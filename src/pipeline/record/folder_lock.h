/// One process per folder: while one writes to it, another is refused in one line.
///
/// The system lets go of the lock when the process ends, however it ends; nothing is left in the folder. Over
/// a network file system it holds as far as that file system's flock does.
#pragma once

#include <filesystem>

namespace mimicx::pipeline::record {

class FolderLock {
 public:
  /// Makes the folder where it is not there.
  /// @throws OutputRefused where another process holds the lock, DataError where the folder cannot be made
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_;
};

}  // namespace mimicx::pipeline::record
