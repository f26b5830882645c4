/// Constants and the checksum of zip archives. Format: PKWARE APPNOTE 6.3.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mimicx {

inline constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50,
                               kEndOfDirectory = 0x06054b50;
inline constexpr std::size_t kLocalBytes = 30, kCentralBytes = 46, kEndBytes = 22;
inline constexpr std::uint64_t kSaturated32 = 0xFFFFFFFF;
inline constexpr std::uint16_t kStored = 0, kDeflated = 8;
inline constexpr std::uint32_t kDosDate = (0u << 9) | (1u << 5) | 1u;  ///< 1980-01-01; the time is 00:00

inline std::uint32_t crc32_of(const std::uint8_t* data, std::size_t size) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ (c & 1 ? 0xEDB88320u : 0u);
      t[i] = c;
    }
    return t;
  }();
  std::uint32_t c = 0xFFFFFFFF;
  for (std::size_t i = 0; i < size; ++i) c = table[(c ^ data[i]) & 0xFF] ^ (c >> 8);
  return ~c;
}

}  // namespace mimicx
