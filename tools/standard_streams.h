/// Safe standard streams: closed ones are occupied, and control characters in file names are escaped.
#pragma once

#include <ostream>
#include <streambuf>

namespace mimicx::tools {

/// Opens a dummy descriptor for each standard stream that the caller closed (`2>&-`). Otherwise the next
/// opened file would get its number, and messages would be written into it. Printing to such a stream still
/// fails.
void occupy_standard_streams();

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
