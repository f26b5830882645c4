#include "standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <string>
#include <string_view>

#include "core/file.h"

namespace mimicx::tools {
namespace {

constexpr std::string_view kClearLine = "\x1b[K";  ///< the only escape sequence that we print

bool passes(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte >= 0x20 && byte != 0x7F) || c == '\n' || c == '\r' || c == '\t';
}

std::string shown(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t taken = text.starts_with(kClearLine) ? kClearLine.size() : 1;
    if (taken > 1 || passes(text.front())) {
      out += text.substr(0, taken);
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned>(text.front()));
      out += code;
    }
    text.remove_prefix(taken);
  }
  return out;
}

}  // namespace

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1)  // open() returns the lowest free number
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool is_standard_output(const std::filesystem::path& path) { return path == "-"; }

std::ostream& table_stream(const std::filesystem::path& json) {
  return is_standard_output(json) ? std::cerr : std::cout;
}

std::FILE* table_file(const std::filesystem::path& json) {
  return is_standard_output(json) ? stderr : stdout;
}

void write_json(const std::filesystem::path& path, const std::string& text) {
  if (is_standard_output(path)) {
    std::cout << text;
    return;
  }
  make_folder(path.parent_path());
  write_file_atomically(path, text);
}

ShownControls::ShownControls(std::ostream& out) : out_(out), target_(out.rdbuf(this)) {}
ShownControls::~ShownControls() { out_.rdbuf(target_); }

ShownControls::int_type ShownControls::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char one = traits_type::to_char_type(c);
  return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

std::streamsize ShownControls::xsputn(const char* text, std::streamsize count) {
  const std::string out = shown({text, static_cast<std::size_t>(count)});
  const auto size = static_cast<std::streamsize>(out.size());
  return target_->sputn(out.data(), size) == size ? count : 0;
}

int ShownControls::sync() { return target_->pubsync(); }

}  // namespace mimicx::tools
