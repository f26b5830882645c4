#include "core/file.h"

#if defined(__unix__) || defined(__APPLE__)
#define MIMICX_WITH_LOCKS
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <map>
#include <mutex>
#include <system_error>

namespace mimicx {

std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  const auto fail = [&](const std::string& expected, const std::string& found) -> DataError {
    return {path.string(), "", expected, found};
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw fail("a readable file", "none");
  if (error) throw fail("a readable file", error.message());
  if (std::filesystem::is_directory(status)) {
    const std::filesystem::directory_iterator entries(path, error);
    throw fail("a file", error ? "a folder (" + error.message() + ")" : "a folder");
  }
  if (!std::filesystem::is_regular_file(status)) throw fail("a regular file", "something else");
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size > max_bytes) throw fail("at most " + std::to_string(max_bytes) + " bytes", std::to_string(size));
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw fail("a readable file", std::generic_category().message(errno));
  std::string content(static_cast<std::size_t>(size), '\0');
  in.read(content.data(), static_cast<std::streamsize>(size));
  content.resize(static_cast<std::size_t>(in.gcount()));
  return content;
}

namespace {

DataError not_writable(const std::filesystem::path& path, const std::error_code& error) {
  return {path.string(), "", "a writable file", error.message()};
}

/// The error of the last failed operation, EIO if it set none.
std::error_code last_error() { return {errno == 0 ? EIO : errno, std::generic_category()}; }

}  // namespace

std::string read_bytes(const std::filesystem::path& path, std::size_t at, std::size_t count) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return {};  // to open a pipe would wait for a writer
  std::string bytes(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

namespace {

/// Absolute, without links as far as it exists, and without a slash at its end.
std::filesystem::path whole_path(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  std::filesystem::path found = std::filesystem::weakly_canonical(absolute, error);
  if (error) found = absolute.lexically_normal();
  return found.has_filename() ? found : found.parent_path();
}

}  // namespace

bool is_within(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const std::filesystem::path relative = whole_path(path).lexically_relative(whole_path(folder));
  return !relative.empty() && *relative.begin() != "..";
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (!path.empty()) std::filesystem::create_directories(path, error);
  if (error) throw DataError(path.string(), "", "a folder that can be made", error.message());
}

namespace {

/// Names of the files that are being written; a slot is free where it is null.
std::array<std::atomic<const char*>, 64> unfinished{};

void remember(const char* name) {
  for (auto& slot : unfinished) {
    const char* none = nullptr;
    if (slot.compare_exchange_strong(none, name)) return;
  }
}

void forget(const char* name) {
  for (auto& slot : unfinished) {
    const char* mine = name;
    if (slot.compare_exchange_strong(mine, nullptr)) return;
  }
}

/// Locks of the temporary files by which other writers know that they are in use. A killed program leaves its
/// file but no lock, so that the next writer takes the same name.
class Locks {
 public:
  /// @return false where another writer has the file
  bool take(const AtomicFile* owner, const std::filesystem::path& path) {
#ifdef MIMICX_WITH_LOCKS
    for (;;) {
      const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (file < 0) return true;  // opening it again reports the error
      struct stat locked, there;
      const bool free = flock(file, LOCK_EX | LOCK_NB) == 0;
      const bool same = free && fstat(file, &locked) == 0 && stat(path.c_str(), &there) == 0 &&
                        locked.st_ino == there.st_ino && locked.st_dev == there.st_dev;
      if (same) {
        const std::lock_guard guard(mutex_);
        files_[owner] = file;
        return true;
      }
      close(file);
      if (!free) return false;  // else it was renamed meanwhile: again
    }
#else
    static_cast<void>(owner), static_cast<void>(path);
    return true;
#endif
  }
  void release(const AtomicFile* owner) {
#ifdef MIMICX_WITH_LOCKS
    const std::lock_guard guard(mutex_);
    if (const auto found = files_.find(owner); found != files_.end()) {
      close(found->second);
      files_.erase(found);
    }
#else
    static_cast<void>(owner);
#endif
  }

 private:
#ifdef MIMICX_WITH_LOCKS
  std::mutex mutex_;
  std::map<const AtomicFile*, int> files_;
#endif
};
Locks& locks() {
  static Locks all;
  return all;
}

}  // namespace

void remove_unfinished_files() {
  for (const auto& slot : unfinished)
    if (const char* name = slot.load()) std::remove(name);
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path) {
  for (int number = 1; temporary_.empty() || !locks().take(this, temporary_); ++number) {
    temporary_ = path;
    temporary_ +=
        (number == 1 ? "" : "." + std::to_string(number)) + ".mimicx-tmp";  // no user's file has that name
  }
  name_ = temporary_.string();
  remember(name_.c_str());
  errno = 0;
  out_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (out_) return;
  const std::error_code error = last_error();
  forget(name_.c_str());
  locks().release(this);
  throw not_writable(path_, error);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) {
    out_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
  forget(name_.c_str());
  locks().release(this);
}

void AtomicFile::write(std::string_view content) {
  errno = 0;
  out_.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out_) throw not_writable(path_, last_error());
}

void AtomicFile::finish() {
  errno = 0;
  out_.close();
  if (!out_) throw not_writable(path_, last_error());
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw not_writable(path_, error);
  temporary_.clear();
}

void write_file_atomically(const std::filesystem::path& path, const std::string& content) {
  AtomicFile file(path);
  file.write(content);
  file.finish();
}

}  // namespace mimicx
