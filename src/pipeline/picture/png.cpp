#include "pipeline/picture/png.h"

#include <zlib.h>

#include <cstdlib>
#include <stdexcept>

namespace mimicx::pipeline::picture {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift & 0xFFU));
  return bytes;
}

/// Length, type, data, checksum of type and data.
std::string chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  const uLong checksum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(checksum));
}

/// Whichever of left, up and upper left is nearest to left + up − upper left; of equal ones the first.
int paeth(int left, int up, int upper_left) {
  const int estimate = left + up - upper_left;
  const int a = std::abs(estimate - left), b = std::abs(estimate - up), c = std::abs(estimate - upper_left);
  if (a <= b && a <= c) return left;
  return b <= c ? up : upper_left;
}

/// Rows of differences to their prediction, each behind the number of its filter.
std::string filtered(const render::Image& image) {
  constexpr char kPaeth = 4;
  constexpr render::Pixel kOutside{};
  std::string bytes;
  bytes.reserve(image.pixels.size() * 3 + static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    bytes.push_back(kPaeth);
    for (int x = 0; x < image.width; ++x) {
      const render::Pixel p = image.at(x, y), left = x > 0 ? image.at(x - 1, y) : kOutside,
                          up = y > 0 ? image.at(x, y - 1) : kOutside,
                          corner = x > 0 && y > 0 ? image.at(x - 1, y - 1) : kOutside;
      bytes.push_back(static_cast<char>(p.r - paeth(left.r, up.r, corner.r)));
      bytes.push_back(static_cast<char>(p.g - paeth(left.g, up.g, corner.g)));
      bytes.push_back(static_cast<char>(p.b - paeth(left.b, up.b, corner.b)));
    }
  }
  return bytes;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib: compress2 failed");
  out.resize(size);
  return out;
}

}  // namespace

std::string format_png(const render::Image& image) {
  const std::string form{"\x08\x02\x00\x00\x00", 5};  // 8 bits, RGB, deflate, adaptive filters, no interlace
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(static_cast<std::uint32_t>(image.width)) +
                           big_endian(static_cast<std::uint32_t>(image.height)) + form) +
         chunk(kPngOpening.substr(0, 4), kPngOpening.substr(4)) + chunk("IDAT", compressed(filtered(image))) +
         chunk("IEND", "");
}

}  // namespace mimicx::pipeline::picture
