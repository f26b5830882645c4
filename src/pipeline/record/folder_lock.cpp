#include "pipeline/record/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/file.h"
#include "pipeline/record/outputs.h"

namespace mimicx::pipeline::record {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  make_folder(folder);
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw DataError(folder.string(), "", "a folder", std::generic_category().message(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;  // some systems have no locks
  close(descriptor_);
  throw OutputRefused(folder.string() + ": another mimicx is writing to this folder");
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace mimicx::pipeline::record
