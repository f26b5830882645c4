#include "core/npz/npy_header.h"

#include <cstring>
#include <utility>

#include "core/error.h"

namespace mimicx {
namespace {

constexpr std::size_t kMaxDimensions = 32;  // NumPy's own limit
constexpr std::uint64_t kMaxItems = std::uint64_t{1} << 40;

using Type = NpyArray::Type;

NpyFileType file_type_of(const std::string& descr, const std::string& path, const std::string& place) {
  const auto unsupported = [&] {
    return UnsupportedArray(path, place, "f2-f8, i1-i8, u1-u8, b1, U or S",
                            descr.find('O') != std::string::npos
                                ? "an object array (a pickle, which is never executed)"
                                : "type '" + descr + "'");
  };
  NpyFileType t;
  std::size_t at = 0;
  if (!descr.empty() && std::string_view("<>|=").find(descr[0]) != std::string_view::npos)
    t.big_endian = descr[at++] == '>';
  if (at >= descr.size()) raise(unsupported());
  t.kind = descr[at++];
  std::size_t count = 0;
  for (; at < descr.size() && descr[at] >= '0' && descr[at] <= '9' && count < (1u << 24); ++at)
    count = 10 * count + static_cast<std::size_t>(descr[at] - '0');
  if (at != descr.size() || count >= (1u << 24)) raise(unsupported());
  t.bytes = t.kind == 'U' ? 4 * count : count;
  const auto is = [&](char kind, std::size_t bytes) { return t.kind == kind && t.bytes == bytes; };
  if (is('f', 8))
    t.type = Type::kFloat64;
  else if (is('f', 4) || is('f', 2))
    t.type = Type::kFloat32;
  else if (is('i', 8) || is('u', 8) || is('u', 4))
    t.type = Type::kInt64;
  else if (is('i', 4) || is('i', 2) || is('i', 1) || is('u', 2))
    t.type = Type::kInt32;
  else if (is('u', 1))
    t.type = Type::kUInt8;
  else if (is('b', 1))
    t.type = Type::kBool;
  else if (t.kind == 'U' || t.kind == 'S')
    t.type = Type::kText;
  else
    raise(unsupported());
  return t;
}

/// Reads the Python literal {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), } of an npy header.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& path, const std::string& place)
      : text_(text), path_(path), place_(place) {}

  NpyHeader parse() {
    NpyHeader header;
    bool has_descr = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr") {
        if (peek() != '\'' && peek() != '"')
          raise(UnsupportedArray(path_, place_, "numbers or text", "an array of records"));
        header.element = file_type_of(quoted(), path_, place_);
        has_descr = true;
      } else if (key == "fortran_order") {
        header.fortran_order = boolean();
        has_order = true;
      } else if (key == "shape") {
        header.shape = tuple();
        has_shape = true;
      } else {
        fail("descr, fortran_order and shape", "key '" + key + "'");
      }
      if (!accept(',') && peek() != '}') fail("',' or '}' in the header", "something else");
    }
    if (!has_descr || !has_order || !has_shape) fail("descr, fortran_order and shape", "fewer keys");
    return header;
  }

 private:
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    raise(DataError(path_, place_, expected, found));
  }
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c || c == '\0') return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' in the npy header", "something else");
  }
  std::string quoted() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a quoted word in the npy header", "something else");
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("a closing quote in the npy header", "its end");
    std::string word(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return word;
  }
  bool boolean() {
    peek();
    for (const std::string_view word : {"True", "False"}) {
      if (text_.substr(at_, word.size()) != word) continue;
      at_ += word.size();
      return word == "True";
    }
    fail("True or False in the npy header", "something else");
  }
  std::vector<std::size_t> tuple() {
    std::vector<std::size_t> values;
    expect('(');
    while (!accept(')')) {
      if (values.size() == kMaxDimensions) fail("at most 32 dimensions", "more");
      values.push_back(number());
      accept('L');  // long integers of Python 2
      if (!accept(',') && peek() != ')') fail("',' or ')' in the shape", "something else");
    }
    return values;
  }
  std::size_t number() {
    std::uint64_t value = 0;
    std::size_t digits = 0;
    for (char c = peek(); c >= '0' && c <= '9'; c = at_ < text_.size() ? text_[at_] : '\0', ++digits) {
      value = 10 * value + static_cast<std::uint64_t>(c - '0');
      if (value > kMaxItems || !std::in_range<std::size_t>(value))
        fail("a shape that fits into memory", "a dimension over 2^40");
      ++at_;
    }
    if (digits == 0) fail("a number in the shape", "something else");
    return static_cast<std::size_t>(value);
  }

  std::string_view text_;
  const std::string& path_;
  const std::string& place_;
  std::size_t at_ = 0;
};

}  // namespace

NpyHeader parse_npy_header(const std::uint8_t* data, std::size_t size, const std::string& path,
                           const std::string& place) {
  if (size < 12 || std::memcmp(data, kNpyMagic.data(), kNpyMagic.size()) != 0)
    raise(DataError(path, place, "an npy array", "other content"));
  const int version = data[6];
  if (version < 1 || version > 3)
    raise(DataError(path, place, "npy version 1, 2 or 3", "version " + std::to_string(version)));
  std::size_t length = 0;
  for (int i = version == 1 ? 1 : 3; i >= 0; --i) length = (length << 8) | data[8 + i];
  const std::size_t start = version == 1 ? 10 : 12;
  if (length > size - start) raise(DataError(path, place, "a complete npy header", "the end of the data"));
  NpyHeader header = HeaderParser({reinterpret_cast<const char*>(data) + start, length}, path, place).parse();
  header.start = start + length;
  return header;
}

std::string format_npy_header(const std::string& descr, const std::vector<std::size_t>& dimensions) {
  std::string shape;
  for (const std::size_t n : dimensions) shape += (shape.empty() ? "" : ", ") + std::to_string(n);
  if (dimensions.size() == 1) shape += ",";
  std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string out(kNpyMagic);
  out += '\x01';
  out += '\x00';
  out += static_cast<char>(header.size() & 0xFF);
  out += static_cast<char>(header.size() >> 8);
  return out + header;
}

}  // namespace mimicx
