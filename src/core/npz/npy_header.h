/// The header of an npy array: element type, order and shape.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/npz/npy_array.h"

namespace mimicx {

inline constexpr std::string_view kNpyMagic = "\x93NUMPY";

/// Element type in the file.
struct NpyFileType {
  char kind = 'f';        ///< f, i, u, b, U or S
  std::size_t bytes = 8;  ///< per element
  bool big_endian = false;
  NpyArray::Type type = NpyArray::Type::kFloat64;  ///< what it is read as
};

struct NpyHeader {
  NpyFileType element;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t start = 0;  ///< offset of the elements, after magic, version, length and header
};

/// @throws DataError if it is damaged, UnsupportedArray if its element type is not supported.
NpyHeader parse_npy_header(const std::uint8_t* data, std::size_t size, const std::string& path,
                           const std::string& place);

/// "{'descr': …}" padded so that the elements start at a multiple of 64 bytes, magic included.
std::string format_npy_header(const std::string& descr, const std::vector<std::size_t>& shape);

}  // namespace mimicx
