#include "record/utf8_names.h"

namespace mimicx::record {
namespace {

unsigned byte_at(const std::string& s, std::size_t i) { return static_cast<unsigned char>(s[i]); }

/// Length of the well-formed sequence that starts at i; 0: it is not well-formed. Unicode 15, table 3-7.
std::size_t sequence_length(const std::string& s, std::size_t i) {
  const unsigned first = byte_at(s, i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || i + length > s.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte_at(s, i + k) & 0xC0) != 0x80) return 0;
  const unsigned second = byte_at(s, i + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || beyond ? 0 : length;
}

/// The byte that a sequence of `to_utf8` stands for; -1 for any other.
int escaped_byte(const std::string& s, std::size_t i) {
  // U+EF80 … U+EFFF are EE BE 80 … EE BF BF.
  if (i + 3 > s.size() || byte_at(s, i) != 0xEE || (byte_at(s, i + 1) & 0xFE) != 0xBE) return -1;
  return static_cast<int>(0x80 | ((byte_at(s, i + 1) & 1) << 6) | (byte_at(s, i + 2) & 0x3F));
}

}  // namespace

std::string to_utf8(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t length = sequence_length(name, i);
    // A name that holds such a code point is escaped byte by byte, so that different names stay different.
    if (length > 0 && escaped_byte(name, i) < 0) {
      out.append(name, i, length);
      i += length;
      continue;
    }
    const unsigned byte = byte_at(name, i++);
    out += {static_cast<char>(0xEE), static_cast<char>(0xBE | (byte >> 6 & 1)),
            static_cast<char>(0x80 | (byte & 0x3F))};
  }
  return out;
}

std::string from_utf8(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const int byte = escaped_byte(text, i);
    if (byte < 0)
      out += text[i++];
    else
      out += static_cast<char>(byte), i += 3;
  }
  return out;
}

}  // namespace mimicx::record
