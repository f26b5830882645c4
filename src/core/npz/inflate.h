/// Unpacks the deflate format (P. Deutsch, RFC 1951, 1996): what most archives are packed with. For builds
/// without zlib, which is several times as fast and gives the same bytes.
///
/// What it does not do: no checksums (an archive has its own), no streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mimicx {

/// @param packed  may have more bytes behind the end of the format, which are not looked at
/// @param size    bytes that come of it
/// @return none where the data is damaged, ends too early, or does not come to that size
std::optional<std::vector<std::uint8_t>> inflate(std::span<const std::uint8_t> packed, std::size_t size);

}  // namespace mimicx
