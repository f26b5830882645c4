/// Safe standard streams: closed ones are occupied, and control characters in file names are escaped.
#pragma once

#include <cstdio>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string>

namespace mimicx::tools {

/// Opens a dummy descriptor for each standard stream that the caller closed (`2>&-`). Otherwise the next
/// opened file would get its number, and messages would be written into it. Printing to such a stream still
/// fails.
void occupy_standard_streams();

/// Whether an output is standard output: "-".
bool is_standard_output(const std::filesystem::path& path);
/// Where a table is printed beside JSON at `json`: standard output; standard error where the JSON is there.
std::ostream& table_stream(const std::filesystem::path& json);
/// The same for std::fprintf.
std::FILE* table_file(const std::filesystem::path& json);
/// Writes JSON to a file, or to standard output.
void write_json(const std::filesystem::path& path, const std::string& text);

/// While it lives, control characters to a stream are escaped (`\x1b`), because file names may hold any. Line
/// ends, tabs and the sequences of `record::Progress` pass.
class ShownControls : std::streambuf {
 public:
  explicit ShownControls(std::ostream& out);
  ~ShownControls() override;
  ShownControls(const ShownControls&) = delete;
  ShownControls& operator=(const ShownControls&) = delete;

 private:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;

  std::ostream& out_;
  std::streambuf* target_;
};

}  // namespace mimicx::tools
