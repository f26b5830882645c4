#include "picture/png.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/random.h"
#include "core/shell.h"
#include "core/temporary_folder.h"
#include "record/outputs.h"

namespace mimicx::picture {
namespace {

/// Smooth in one half, noise in the other.
render::Image patterned(int width, int height) {
  Random random(6);
  render::Image image(width, height, {});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) =
          x < width / 2 ? render::Pixel{static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(y), 200}
                        : render::Pixel{static_cast<std::uint8_t>(random.uniform(0, 256)),
                                        static_cast<std::uint8_t>(random.uniform(0, 256)),
                                        static_cast<std::uint8_t>(random.uniform(0, 256))};
  return image;
}

/// What read_png.py prints of the pixels.
std::string rows_of(const render::Image& image) {
  std::string text;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      for (const int value : {image.at(x, y).r, image.at(x, y).g, image.at(x, y).b}) {
        text += "0123456789abcdef"[value / 16];
        text += "0123456789abcdef"[value % 16];
      }
    text += '\n';
  }
  return text;
}

void expect_decoded(const std::string& bytes, const std::string& expected) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "no Python here";
  TemporaryFolder folder;
  const std::string file = (folder.path / "a.png").string();
  write_file_atomically(file, bytes);
  const Call call =
      shell("/usr/bin/python3 " MIMICX_SOURCE_DIR "/tests/picture/read_png.py " + file + " 2>&1");
  EXPECT_EQ(call.status, 0);
  EXPECT_EQ(call.text, expected);
}

TEST(Png, AnIndependentDecoderReadsEveryPixel) {
  const render::Image image = patterned(37, 23);
  expect_decoded(format_png(image), "37 23 mimicx\n" + rows_of(image));
}

TEST(Png, AnIndependentDecoderReadsEveryFrameOfAnAnimationAtItsTime) {
  render::Image image = patterned(20, 15);
  PngAnimation animation;
  std::string expected = "20 15 mimicx\n";
  for (int k = 0; k < 5; ++k) {  // a square moves over the pattern; the third frame is the second again
    if (k != 2) {
      image = patterned(20, 15);
      render::paste(render::Image(4, 4, {200, 40, 20}), 3 * k, 2 * k, image);
    }
    animation.add(image, 40 + k);
    expected += "frame " + std::to_string(40 + k) + '\n' + rows_of(image);
  }
  expect_decoded(animation.finish(), expected);
}

TEST(Png, AnimationStoresOnlyWhatChanges) {
  const auto bytes_of = [](int frames) {
    PngAnimation animation;
    for (int k = 0; k < frames; ++k) {
      render::Image image = patterned(200, 150);
      render::paste(render::Image(16, 16, {200, 40, 20}), 8 * k, 16, image);
      animation.add(image, 40);
    }
    return animation.finish().size();
  };
  EXPECT_LT(bytes_of(10) - bytes_of(1), bytes_of(1) / 4);
}

TEST(Png, OwnFilesAreRecognised) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.png";
  const std::string bytes = format_png(patterned(4, 4));
  write_file_atomically(file, bytes);
  EXPECT_TRUE(record::is_own_file(file, kPngOpening, kPngOpeningAt));
  std::string foreign = bytes;
  foreign[kPngOpeningAt + 14] = 'M';
  write_file_atomically(file, foreign);
  EXPECT_FALSE(record::is_own_file(file, kPngOpening, kPngOpeningAt));
}

}  // namespace
}  // namespace mimicx::picture
