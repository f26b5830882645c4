#include "import/text_input.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/file.h"
#include "core/number_text.h"

namespace mimicx::import {
namespace {

std::string in_quotes(std::string_view word) { return std::string(1, '\'').append(word).append(1, '\''); }

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Length of the UTF-8 sequence at the start of `text`; 0 where there is none or it is a control character.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead >= 0xc2 && lead < 0xe0   ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // Overlong forms, surrogates and what lies past U+10FFFF.
  const unsigned char second = byte(1);
  if ((lead == 0xe0 && second < 0xa0) || (lead == 0xed && second >= 0xa0) ||
      (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second >= 0x90))
    return 0;
  return length;
}

}  // namespace

std::string read_text(const std::filesystem::path& path) { return read_file(path, kMaxTextBytes); }

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string escaped_name(std::string_view name) {
  std::string out;
  while (!name.empty()) {
    const std::size_t length = sequence_length(name);
    out += length == 0 ? formatted("\\x%02x", static_cast<unsigned char>(name[0])) : name.substr(0, length);
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string printable(std::string_view word, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < most && !word.empty(); ++i) {
    const std::size_t length = sequence_length(word);
    out += length == 0 ? "?" : word.substr(0, length);
    word.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return word.empty() ? out : out + "...";
}

bool parse_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const std::optional<double> number = number_from(word);
  value = number.value_or(0.0);
  return number && std::isfinite(value);
}

TextInput::TextInput(std::string_view text, std::string path, std::string_view marks)
    : text_(text), path_(std::move(path)), marks_(marks) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);  // byte order mark
}

void TextInput::skip_space() {
  for (; at_ < text_.size() && is_space(text_[at_]); ++at_)
    if (text_[at_] == '\n' || (text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] != '\n')))
      ++line_;
}

void TextInput::skip_comments() {
  skip_space();
  while (text_.substr(at_).starts_with('#') || text_.substr(at_).starts_with("//")) {
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
    skip_space();
  }
}

std::string_view TextInput::word() {
  skip_space();
  const std::size_t begin = at_;
  const auto is_mark = [&](char c) { return marks_.find(c) != std::string_view::npos; };
  if (at_ < text_.size() && is_mark(text_[at_])) return text_.substr(at_++, 1);
  while (at_ < text_.size() && !is_space(text_[at_]) && !is_mark(text_[at_])) {
    // The second byte of a character in Shift-JIS or GBK may be that of a mark, such as '{'.
    const bool leads =
        static_cast<unsigned char>(text_[at_]) >= 0x81 && sequence_length(text_.substr(at_)) == 0;
    const bool follows = at_ + 1 < text_.size() && static_cast<unsigned char>(text_[at_ + 1]) >= 0x40;
    at_ += leads && follows ? 2 : 1;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view TextInput::word_on_line() {
  const std::size_t at = at_, line = line_;
  const std::string_view next = word();
  if (line_ == line) return next;
  at_ = at;
  line_ = line;
  return {};
}

std::string_view TextInput::peek() {
  const std::size_t at = at_, line = line_;
  const std::string_view next = word();
  at_ = at;
  line_ = line;
  return next;
}

std::string_view TextInput::quoted() {
  const std::size_t begin = at_;
  for (; at_ < text_.size(); ++at_) {
    if (text_[at_] == '"') return text_.substr(begin, at_++ - begin);
    if (text_[at_] == '\n') ++line_;
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
  }
  fail_with("a closing quotation mark", "the end of the file");
}

void TextInput::label(std::string_view keyword) {
  const std::string expected = in_quotes(std::string(keyword) + ":");
  const std::string_view found = peek();  // for the message
  skip_space();
  const auto skip_blanks = [&] {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  };
  for (const char c : keyword) {
    if (c == ' ') {
      skip_blanks();
      continue;
    }
    if (at_ == text_.size() || !equal_but_for_case(text_.substr(at_, 1), {&c, 1})) fail(expected, found);
    ++at_;
  }
  skip_blanks();
  if (at_ == text_.size() || text_[at_] != ':') fail(expected, found);
  ++at_;
}

void TextInput::expect(std::string_view expected) {
  const std::string_view found = word();
  if (found != expected) fail(in_quotes(expected), found);
}

double TextInput::number(const std::string& what) {
  const std::string_view text = word();
  double value = 0.0;
  if (!parse_number(text, value)) fail(what, text);
  return value;
}

std::size_t TextInput::integer(const std::string& what, std::size_t low, std::size_t high) {
  const std::string_view text = word();
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < low || value > high)
    fail(what + " (an integer from " + std::to_string(low) + " to " + std::to_string(high) + ")", text);
  return value;
}

void TextInput::fail(const std::string& expected, std::string_view word) const {
  fail_with(expected, word.empty() ? "the end of the file" : in_quotes(printable(word)));
}

void TextInput::fail_with(const std::string& expected, const std::string& found) const {
  throw DataError(path_, "line " + std::to_string(line_), expected, found);
}

}  // namespace mimicx::import
