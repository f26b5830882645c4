#include "core/file.h"

#include <cerrno>
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

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), temporary_(path) {
  temporary_ += ".mimicx-tmp";  // a name that no user's file has
  errno = 0;
  out_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!out_) throw not_writable(path_, last_error());
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  out_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
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
