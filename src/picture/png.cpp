#include "picture/png.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace mimicx::picture {
namespace {

std::string big_endian(auto number) {
  const auto value = static_cast<std::uint32_t>(number);
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift & 0xFFU));
  return bytes;
}

/// Length, type, data, checksum of type and data.
std::string chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  const uLong checksum =
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(data.size()) + body + big_endian(checksum);
}

/// Whichever of left, up and upper left is nearest to left + up − upper left; of equal ones the first.
int paeth(int left, int up, int upper_left) {
  const int estimate = left + up - upper_left;
  const int a = std::abs(estimate - left), b = std::abs(estimate - up), c = std::abs(estimate - upper_left);
  if (a <= b && a <= c) return left;
  return b <= c ? up : upper_left;
}

/// Channels of 8 bits, side by side.
struct Raster {
  int width, height, channels;
  std::string bytes;  ///< [height · width · channels]
};

/// Rows of differences to their prediction, each behind the number of its filter.
std::string filtered(const Raster& raster) {
  constexpr char kPaeth = 4;
  const int row = raster.width * raster.channels;
  const auto value = [&](int y, int x) {
    return y < 0 || x < 0 ? 0
                          : static_cast<int>(static_cast<std::uint8_t>(
                                raster.bytes[static_cast<std::size_t>(y * row + x)]));
  };
  std::string rows;
  rows.reserve(raster.bytes.size() + static_cast<std::size_t>(raster.height));
  for (int y = 0; y < raster.height; ++y) {
    rows.push_back(kPaeth);
    for (int x = 0; x < row; ++x) {
      const int left = x - raster.channels;
      rows.push_back(
          static_cast<char>(value(y, x) - paeth(value(y, left), value(y - 1, x), value(y - 1, left))));
    }
  }
  return rows;
}

std::string compressed(const std::string& bytes, int level) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), level) != Z_OK)
    throw std::runtime_error("zlib: compress2 failed");
  out.resize(size);
  return out;
}

/// Signature, header and who made it. @param colour  2: RGB, 6: RGBA
std::string opening(const render::Image& image, char colour) {
  const std::string form{8, colour, 0, 0, 0};  // bits; deflate, adaptive filters, no interlace
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big_endian(image.width) + big_endian(image.height) + form) +
         chunk(kPngOpening.substr(0, 4), kPngOpening.substr(4));
}

struct Rectangle {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< up to right and bottom, exclusive
};

/// Around all pixels that differ; one pixel where none does, since no frame may be empty.
Rectangle changed(const render::Image& a, const render::Image& b) {
  Rectangle box{a.width, a.height, 0, 0};
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (a.at(x, y) != b.at(x, y))
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
               std::max(box.bottom, y + 1)};
  return box.right == 0 ? Rectangle{0, 0, 1, 1} : box;
}

/// The pixels of the rectangle, those transparent that are as they were. @param before  none: all are new
Raster difference(const render::Image& image, const render::Image* before, const Rectangle& box) {
  Raster raster{box.right - box.left, box.bottom - box.top, 4, {}};
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const render::Pixel p = image.at(x, y);
      if (before && p == before->at(x, y))
        raster.bytes.append(4, '\0');
      else
        for (const int value : {int{p.r}, int{p.g}, int{p.b}, 255})
          raster.bytes.push_back(static_cast<char>(value));
    }
  return raster;
}

}  // namespace

std::string format_png(const render::Image& image) {
  Raster raster{image.width, image.height, 3, {}};
  for (const render::Pixel& p : image.pixels)
    for (const std::uint8_t value : {p.r, p.g, p.b}) raster.bytes.push_back(static_cast<char>(value));
  return opening(image, 2) + chunk("IDAT", compressed(filtered(raster), Z_BEST_COMPRESSION)) +
         chunk("IEND", "");
}

void PngAnimation::add(const render::Image& image, int milliseconds) {
  const bool first = frames_ == 0;
  const Rectangle box = first ? Rectangle{0, 0, image.width, image.height} : changed(image, last_);
  const std::string time = big_endian(milliseconds).substr(2) + big_endian(1000).substr(2);
  const std::string over{0, 1};  // the frame stays as it is, and the next one is drawn over it
  chunks_ += chunk("fcTL", big_endian(next_++) + big_endian(box.right - box.left) +
                               big_endian(box.bottom - box.top) + big_endian(box.left) + big_endian(box.top) +
                               time + over);
  const Raster raster = difference(image, first ? nullptr : &last_, box);
  // The best compression saves 2 % and takes twice as long.
  const std::string data = compressed(filtered(raster), Z_DEFAULT_COMPRESSION);
  chunks_ += first ? chunk("IDAT", data) : chunk("fdAT", big_endian(next_++) + data);
  last_ = image;
  ++frames_;
}

std::string PngAnimation::finish() const {
  const int for_ever = 0;
  return opening(last_, 6) + chunk("acTL", big_endian(frames_) + big_endian(for_ever)) + chunks_ +
         chunk("IEND", "");
}

}  // namespace mimicx::picture
