/// Unpacks the deflate format of most archives (P. Deutsch, RFC 1951, 1996), for builds without zlib. zlib
/// gives the same bytes and is several times as fast.
///
/// What it does not do: no checksums (an archive has its own), no streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mimicx {

/// @param packed  bytes after the end of the deflate stream are ignored
/// @param size    bytes of the result
/// @return none if the data is damaged, truncated, or of another size
std::optional<std::vector<std::uint8_t>> inflate(std::span<const std::uint8_t> packed, std::size_t size);

}  // namespace mimicx
