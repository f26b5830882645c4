#include "pipeline/picture/png.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "core/random.h"
#include "pipeline/record/outputs.h"
#include "pipeline/shell.h"
#include "pipeline/temporary_folder.h"

namespace mimicx::pipeline::picture {
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

TEST(Png, AnIndependentDecoderReadsEveryPixel) {
  if (!std::filesystem::exists("/usr/bin/python3")) GTEST_SKIP() << "no Python here";
  TemporaryFolder folder;
  const std::string file = (folder.path / "a.png").string();
  const render::Image image = patterned(37, 23);
  write_file_atomically(file, format_png(image));
  std::string expected = "37 23 mimicx\n";
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      for (const int value : {image.at(x, y).r, image.at(x, y).g, image.at(x, y).b}) {
        expected += "0123456789abcdef"[value / 16];
        expected += "0123456789abcdef"[value % 16];
      }
    expected += '\n';
  }
  const Call call =
      shell("/usr/bin/python3 " MIMICX_SOURCE_DIR "/tests/pipeline/picture/read_png.py " + file + " 2>&1");
  EXPECT_EQ(call.status, 0);
  EXPECT_EQ(call.text, expected);
}

TEST(Png, OursAreKnownAgain) {
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
}  // namespace mimicx::pipeline::picture
