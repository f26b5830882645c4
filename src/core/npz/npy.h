/// NumPy arrays: read what NumPy writes, write what NumPy opens.
///
/// Format: NumPy Enhancement Proposal 1 (npy). What it does not do: object arrays (they are pickles: running
/// foreign code), complex and structured types.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/npz/npy_array.h"

namespace mimicx {

/// Most bytes that an archive, or one array, may unpack to: 2 GiB hold 20 hours of SMPL-X poses at 30 fps.
inline constexpr std::size_t kMaxMemberBytes = std::size_t{1} << 31;

/// Parses one npy member. @param path, place  for messages.
/// @throws DataError when it is damaged, UnsupportedArray when it is of a kind that is not read.
NpyArray parse_npy(const std::uint8_t* data, std::size_t size, const std::string& path,
                   const std::string& place, std::size_t max_bytes = kMaxMemberBytes);
/// npy version 1.0, C order.
std::string format_npy(const NpyArray& array);

}  // namespace mimicx
