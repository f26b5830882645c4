#include "core/npz/npy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/bits.h"
#include "core/error.h"
#include "core/npz/npy_header.h"

namespace mimicx {
namespace {

static_assert(std::endian::native == std::endian::little, "elements are kept little endian");

constexpr std::size_t kMaxEmptyTexts = 65536;  ///< elements of no bytes: the file does not bound their number

using Type = NpyArray::Type;

std::size_t element_bytes(Type type) {
  switch (type) {
    case Type::kFloat64:
    case Type::kInt64:
      return 8;
    case Type::kFloat32:
    case Type::kInt32:
      return 4;
    case Type::kUInt8:
    case Type::kBool:
      return 1;
    case Type::kText:
      return sizeof(std::string);
  }
  return 0;
}

/// IEEE 754 half precision.
float half_to_float(std::uint16_t h) {
  const std::uint32_t sign = (h & 0x8000u) << 16, exponent = (h >> 10) & 0x1Fu, fraction = h & 0x3FFu;
  if (exponent == 0) {  // zero and subnormals
    const float value = static_cast<float>(fraction) * 0x1.0p-24f;
    return sign ? -value : value;
  }
  const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
  return mimicx::bit_cast<float>(sign | (wide << 23) | (fraction << 13));
}

template <class T>
T load(const std::uint8_t* p, bool big_endian) {
  std::array<std::uint8_t, sizeof(T)> raw;
  std::memcpy(raw.data(), p, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  return mimicx::bit_cast<T>(raw);
}

template <class T>
void store(std::uint8_t* out, T value) {
  std::memcpy(out, &value, sizeof(T));
}

void append_utf8(std::string& out, std::uint32_t c) {
  const auto put = [&](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6)), put(0x80 | (c & 63));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12)), put(0x80 | ((c >> 6) & 63)), put(0x80 | (c & 63));
  } else {
    put(0xF0 | (c >> 18)), put(0x80 | ((c >> 12) & 63)), put(0x80 | ((c >> 6) & 63)), put(0x80 | (c & 63));
  }
}

/// Code points of a UTF-8 string; a byte that is no UTF-8 counts as Latin-1.
std::vector<std::uint32_t> code_points(const std::string& text) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
    };
    const std::uint32_t first = byte(i);
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    std::uint32_t c = length == 1 ? first : first & (0xFFu >> (length + 1));
    bool valid = i + length <= text.size();
    for (std::size_t k = 1; valid && k < length; ++k) {
      valid = (byte(i + k) & 0xC0) == 0x80;
      c = (c << 6) | (byte(i + k) & 63);
    }
    if (c > 0x10FFFF) valid = false;
    out.push_back(valid ? c : first);
    i += valid ? length : 1;
  }
  return out;
}

std::string read_text(const std::uint8_t* p, const NpyFileType& t, const std::string& path,
                      const std::string& place) {
  std::string out;
  if (t.kind == 'S') {
    out.assign(p, p + t.bytes);
  } else {
    for (std::size_t k = 0; k < t.bytes; k += 4) {
      const auto c = load<std::uint32_t>(p + k, t.big_endian);
      if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000))
        raise(DataError(path, place, "text", "an invalid code point"));
      append_utf8(out, c);
    }
  }
  out.erase(std::find_if(out.rbegin(), out.rend(), [](char c) { return c != '\0'; }).base(), out.end());
  return out;
}

/// One element of the file, widened to the type it is read as.
void read_number(const std::uint8_t* p, const NpyFileType& t, std::uint8_t* out, const std::string& path,
                 const std::string& place) {
  const bool big = t.big_endian;
  const auto is = [&](char kind, std::size_t bytes) { return t.kind == kind && t.bytes == bytes; };
  if (is('f', 2))
    store(out, half_to_float(load<std::uint16_t>(p, big)));
  else if (is('i', 1))
    store(out, std::int32_t{static_cast<std::int8_t>(*p)});
  else if (is('i', 2))
    store(out, std::int32_t{load<std::int16_t>(p, big)});
  else if (is('u', 2))
    store(out, std::int32_t{load<std::uint16_t>(p, big)});
  else if (is('u', 4))
    store(out, std::int64_t{load<std::uint32_t>(p, big)});
  else if (is('b', 1))
    *out = *p ? 1 : 0;
  else if (t.bytes == 1)
    *out = *p;
  else if (t.bytes == 4)
    store(out, load<std::uint32_t>(p, big));
  else
    store(out, load<std::uint64_t>(p, big));
  if (is('u', 8) && load<std::int64_t>(out, false) < 0)
    raise(UnsupportedArray(path, place, "values under 2^63", "a larger one"));
}

/// Offset (in elements) in a fortran-ordered block of the element with C-order index `i`.
std::size_t fortran_index(std::size_t i, const std::vector<std::size_t>& shape) {
  std::size_t offset = 0, stride = 1;
  for (const std::size_t n : shape) stride *= n;
  for (std::size_t d = shape.size(); d-- > 0;) {
    stride /= shape[d];
    offset += (i % shape[d]) * stride;
    i /= shape[d];
  }
  return offset;
}

std::string descr_of(const NpyArray& array, std::size_t characters) {
  switch (array.type) {
    case Type::kFloat32:
      return "<f4";
    case Type::kFloat64:
      return "<f8";
    case Type::kInt32:
      return "<i4";
    case Type::kInt64:
      return "<i8";
    case Type::kUInt8:
      return "|u1";
    case Type::kBool:
      return "|b1";
    case Type::kText:
      break;
  }
  return "<U" + std::to_string(characters);
}

}  // namespace

NpyArray parse_npy(const std::uint8_t* data, std::size_t size, const std::string& path,
                   const std::string& place, std::size_t max_bytes) {
  const NpyHeader header = parse_npy_header(data, size, path, place);
  const NpyFileType& t = header.element;
  const std::size_t start = header.start;
  const std::size_t per_item =
      t.type == Type::kText ? element_bytes(t.type) + t.bytes : element_bytes(t.type);
  const bool empty = std::find(header.shape.begin(), header.shape.end(), 0u) != header.shape.end();
  std::size_t count = empty ? 0 : 1;
  for (const std::size_t n : header.shape) {
    if (count == 0) break;
    if (n > max_bytes / per_item / count)
      raise(DataError(path, place, "at most " + std::to_string(max_bytes) + " bytes", "a larger array"));
    count *= n;
  }
  if (t.bytes == 0 && count > kMaxEmptyTexts)
    raise(DataError(path, place, "text of one character or more", std::to_string(count) + " empty elements"));
  if (count * t.bytes != size - start)
    raise(DataError(path, place, std::to_string(count * t.bytes) + " bytes of elements",
                    std::to_string(size - start)));
  NpyArray array;
  array.type = t.type;
  array.shape = header.shape;
  const std::size_t width = element_bytes(t.type);
  if (t.type == Type::kText)
    array.text.reserve(count);
  else
    array.bytes.resize(count * width);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* item =
        data + start + t.bytes * (header.fortran_order ? fortran_index(i, array.shape) : i);
    if (t.type == Type::kText)
      array.text.push_back(read_text(item, t, path, place));
    else
      read_number(item, t, array.bytes.data() + i * width, path, place);
  }
  return array;
}

std::string format_npy(const NpyArray& array) {
  std::vector<std::vector<std::uint32_t>> text;
  std::size_t characters = 1;
  for (const std::string& s : array.text) {
    text.push_back(code_points(s));
    characters = std::max(characters, text.back().size());
  }
  std::string out = format_npy_header(descr_of(array, characters), array.shape);
  out.append(array.bytes.begin(), array.bytes.end());
  for (std::vector<std::uint32_t>& s : text) {
    s.resize(characters, 0);
    for (const std::uint32_t c : s)
      for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((c >> shift) & 0xFF);
  }
  return out;
}

}  // namespace mimicx
