/// Reads text files word by word, with the line of every word for messages. Lines end in \n, \r\n or \r, in
/// any mixture; other control characters and bytes outside ASCII are ordinary characters of a word.
///
/// What it does not do: no locale (`number_from` reads numbers), no encodings other than UTF-8.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"

namespace mimicx::import {

inline constexpr std::size_t kMaxTextBytes = std::size_t{1} << 30;

/// The bytes of a file. @throws DataError when it is not a readable file, or larger than `kMaxTextBytes`
std::string read_text(const std::filesystem::path& path);

/// At most `most` characters of a word as valid UTF-8; control characters and invalid bytes become '?'.
std::string printable(std::string_view word, std::size_t most = 40);

/// A name as valid UTF-8, whole and distinct from every other: each control character and invalid byte
/// becomes its hexadecimal number, "\\x83". Names in another encoding (Shift-JIS, GBK) can so be compared.
std::string escaped_name(std::string_view name);

/// Whether two words are equal but for upper and lower case (ASCII).
bool equal_but_for_case(std::string_view a, std::string_view b);

class TextInput {
 public:
  /// @param path  for messages @param marks  characters that are words of their own, e.g. "{}"
  TextInput(std::string_view text, std::string path, std::string_view marks = "");

  /// Skips lines in front that begin with '#' or "//".
  void skip_comments();
  /// The next word; empty at the end of the text. Its line is `line()`.
  std::string_view word();
  /// The next word if it is on the same line as the last one, else empty.
  std::string_view word_on_line();
  /// The next word without reading on.
  std::string_view peek();
  /// The text up to the next quotation mark, which is read as well; a backslash escapes the next character.
  std::string_view quoted();
  /// Reads "KEYWORD:", in any case, with or without blanks around its colon; the next word is what stands
  /// behind it. @param keyword  words divided by single blanks, between which the text may have any or none
  void label(std::string_view keyword);
  /// Throws unless the next word is `expected`.
  void expect(std::string_view expected);
  /// The next word as a finite number. @param what  its meaning, for the message
  double number(const std::string& what);
  /// The next word as an integer between `low` and `high`.
  std::size_t integer(const std::string& what, std::size_t low, std::size_t high);

  std::size_t bytes_left() const { return text_.size() - at_; }
  std::size_t line() const { return line_; }
  const std::string& path() const { return path_; }
  /// Throws DataError with the current line. @param word  the word found; empty: the end of the file
  [[noreturn]] void fail(const std::string& expected, std::string_view word) const;
  [[noreturn]] void fail_with(const std::string& expected, const std::string& found) const;

 private:
  void skip_space();

  std::string_view text_;
  std::string path_;
  std::string_view marks_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// Reads a word as a finite number. @return false when it is not a number
bool parse_number(std::string_view word, double& value);

}  // namespace mimicx::import
