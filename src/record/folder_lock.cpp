#include "record/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/file.h"
#include "record/outputs.h"

namespace mimicx::record {

FolderLock::FolderLock(const std::filesystem::path& folder, Hold hold, const std::string& file) {
  make_folder(folder);
  const std::filesystem::path path = file.empty() ? folder : folder / file;
  descriptor_ = file.empty() ? open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                             : open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw DataError(path.string(), "", file.empty() ? "a folder" : "a writable file",
                    std::generic_category().message(errno));
  if (flock(descriptor_, (hold == Hold::kAlone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;  // some systems have no locks
  close(descriptor_);
  throw OutputRefused(folder.string() + ": another mimicx is writing to this folder");
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace mimicx::record
