#include "core/file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
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

/// A number that no other program has that starts at another moment.
std::string own_number() {
  static const auto start = std::chrono::system_clock::now().time_since_epoch().count();
  static std::atomic<unsigned> count = 0;
  return std::to_string(start) + "-" + std::to_string(count++);
}

}  // namespace

void remove_unfinished_files() {
  for (const auto& slot : unfinished)
    if (const char* name = slot.load()) std::remove(name);
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), temporary_(path) {
  temporary_ += "." + own_number() + ".mimicx-tmp";  // a name that no user's file has
  name_ = temporary_.string();
  remember(name_.c_str());
  errno = 0;
  out_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (out_) return;
  const std::error_code error = last_error();
  forget(name_.c_str());
  throw not_writable(path_, error);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) {
    out_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
  forget(name_.c_str());
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
