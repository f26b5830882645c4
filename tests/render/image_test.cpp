#include "render/image.h"

#include <gtest/gtest.h>

namespace mimicx::render {
namespace {

TEST(Image, PixelValuesRoundTripThroughLight) {
  for (int v = 0; v < 256; ++v) {
    const Pixel pixel{static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(255 - v), 7};
    EXPECT_EQ(shown(light_of(pixel)), pixel) << v;
  }
  EXPECT_EQ(shown({-1.0F, 0.25F, 9.0F}), (Pixel{0, 128, 255}));
}

TEST(Image, PastePutsThePartAtItsPlace) {
  Image image(5, 4, {1, 1, 1});
  paste(Image(2, 3, {9, 9, 9}), 3, 1, image);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(image.at(x, y).r, x >= 3 && y >= 1 ? 9 : 1);
  EXPECT_THROW(paste(Image(2, 3, {}), 4, 1, image), std::invalid_argument);
}

}  // namespace
}  // namespace mimicx::render
