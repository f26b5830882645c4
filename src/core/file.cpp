#include "core/file.h"

#include <cerrno>
#include <fstream>
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
  std::string content(size, '\0');
  in.read(content.data(), static_cast<std::streamsize>(size));
  content.resize(static_cast<std::size_t>(in.gcount()));
  return content;
}

void write_file_atomically(const std::filesystem::path& path, const std::string& content) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  std::error_code error;
  errno = 0;
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.flush();
    if (!out) error.assign(errno == 0 ? EIO : errno, std::generic_category());
  }
  if (!error) std::filesystem::rename(temporary, path, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw DataError(path.string(), "", "a writable file", error.message());
}

}  // namespace mimicx
