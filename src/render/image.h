/// Pictures of 8-bit pixels.
#pragma once

#include <cstdint>

#include "core/containers.h"
#include "core/so3.h"

namespace mimicx::render {

/// Light of the three primaries, linear, 1 is white.
using Colour = Eigen::Vector3f;

/// A pixel of a screen: red, green, blue.
struct Pixel {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Pixel&) const = default;
};

/// The pixel of a colour. The square root approximates the screen's gamma of 2.2, because every processor
/// rounds it correctly, unlike powers.
Pixel shown(const Colour& light);
/// The colour of a pixel: shown(light_of(p)) == p.
Colour light_of(const Pixel& pixel);

/// Rows from the top, pixels from the left.
struct Image {
  Image() = default;
  Image(int w, int h, const Pixel& fill) : width(w), height(h), pixels(w * h, fill) {}
  Pixel& at(int x, int y) { return pixels[y * width + x]; }
  const Pixel& at(int x, int y) const { return pixels[y * width + x]; }

  int width = 0, height = 0;
  List<Pixel> pixels;  ///< [height · width]
};

/// Copies an image into another one, its upper left corner at (x, y). It must lie completely inside.
void paste(const Image& part, int x, int y, Image& onto);

}  // namespace mimicx::render
