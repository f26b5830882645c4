#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mimicx::render {
namespace {

std::uint8_t shown_channel(float light) {
  return static_cast<std::uint8_t>(255.0F * std::sqrt(std::clamp(light, 0.0F, 1.0F)) + 0.5F);
}

float channel_light(std::uint8_t value) {
  const float v = static_cast<float>(value) / 255.0F;
  return v * v;
}

}  // namespace

Pixel shown(const Colour& light) {
  return {shown_channel(light.x()), shown_channel(light.y()), shown_channel(light.z())};
}

Colour light_of(const Pixel& pixel) {
  return {channel_light(pixel.r), channel_light(pixel.g), channel_light(pixel.b)};
}

void paste(const Image& part, int x, int y, Image& onto) {
  if (x < 0 || y < 0 || x + part.width > onto.width || y + part.height > onto.height)
    throw std::invalid_argument("paste: the part reaches over the edge of the image");
  for (int row = 0; row < part.height; ++row)
    std::copy_n(part.pixels.begin() + row * part.width, part.width,
                onto.pixels.begin() + (y + row) * onto.width + x);
}

}  // namespace mimicx::render
