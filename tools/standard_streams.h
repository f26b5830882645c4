/// The standard streams as a program needs them that names files of any name and writes many others.
#pragma once

#include <ostream>
#include <streambuf>

namespace mimicx::tools {

/// Puts a closed end where the caller left none (`2>&-`): the next file to be opened would else be taken for
/// the stream, and messages be written into it. What is printed to a closed end fails, as it did.
void occupy_standard_streams();

/// While it lives, control characters that reach a stream are shown (`\x1b`) and not obeyed by a terminal:
/// names of files may hold any. Line ends, tabs and what `record::Progress` draws its line with pass.
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
