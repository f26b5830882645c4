/// NumPy arrays: reads npy files as NumPy writes them, and writes npy files that NumPy reads.
///
/// Format: NumPy Enhancement Proposal 1 (npy). Not supported: object arrays (they are pickles, which run
/// foreign code), complex and structured types, and whole numbers of 2^63 and more.
#pragma once

#include <cstdint>
#include <string>

#include "core/npz/npy_array.h"

namespace mimicx {

/// Limit of the unpacked size of an archive or an array: 2 GiB hold 20 hours of SMPL-X poses at 30 fps.
inline constexpr std::size_t kMaxMemberBytes = std::size_t{1} << 31;

/// Parses one npy member. @param path, place  for messages.
/// @throws DataError if it is damaged, UnsupportedArray if its elements are not supported.
NpyArray parse_npy(const std::uint8_t* data, std::size_t size, const std::string& path,
                   const std::string& place, std::size_t max_bytes = kMaxMemberBytes);
/// npy version 1.0, C order.
std::string format_npy(const NpyArray& array);

}  // namespace mimicx
