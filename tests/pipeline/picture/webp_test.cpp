#include "pipeline/picture/webp.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "pipeline/record/outputs.h"
#include "pipeline/temporary_folder.h"

#ifdef MIMICX_WITH_WEBP
#include <webp/demux.h>

namespace mimicx::pipeline::picture {
namespace {

constexpr int kWidth = 64, kHeight = 48, kFrames = 5, kStep = 40;

/// A square that moves on a grey ground.
render::Image frame(int k) {
  render::Image image(kWidth, kHeight, {120, 120, 120});
  render::paste(render::Image(16, 16, {200, 40, 20}), 8 * k, 16, image);
  return image;
}

std::string film() {
  WebpAnimation file(kWidth, kHeight);
  for (int k = 0; k < kFrames; ++k) file.add(frame(k), kStep * k);
  return file.finish(kStep * kFrames);
}

TEST(Webp, ADecoderFindsEveryFrameAtItsTime) {
  const std::string bytes = film();
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoderOptions options;
  WebPAnimDecoderOptionsInit(&options);
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(
      WebPAnimDecoderNew(&data, &options), WebPAnimDecoderDelete);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder.get(), &info);
  EXPECT_EQ(info.canvas_width, kWidth);
  EXPECT_EQ(info.canvas_height, kHeight);
  EXPECT_EQ(info.frame_count, kFrames);
  EXPECT_EQ(info.loop_count, 0u) << "for ever";
  for (int k = 0; k < kFrames; ++k) {
    std::uint8_t* rgba = nullptr;
    int ends = 0;
    ASSERT_TRUE(WebPAnimDecoderGetNext(decoder.get(), &rgba, &ends));
    EXPECT_EQ(ends, kStep * (k + 1));
    const render::Image image = frame(k);
    double error = 0.0;
    for (int i = 0; i < kWidth * kHeight; ++i)
      error += std::abs(rgba[4 * i] - image.pixels[i].r) / static_cast<double>(kWidth * kHeight);
    EXPECT_LT(error, 4.0) << "lossy, but near; a frame too early or too late has 13";
  }
}

TEST(Webp, EqualFramesGiveEqualBytesAndOursAreKnownAgain) {
  TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.webp";
  const std::string bytes = film();
  EXPECT_EQ(bytes, film());
  write_file_atomically(file, bytes);
  EXPECT_TRUE(record::is_own_file(file, kWebpEnding, record::kAtTheEnd));
  write_file_atomically(file, bytes + "x");
  EXPECT_FALSE(record::is_own_file(file, kWebpEnding, record::kAtTheEnd));
  write_file_atomically(file, "short");
  EXPECT_FALSE(record::is_own_file(file, kWebpEnding, record::kAtTheEnd));
}

}  // namespace
}  // namespace mimicx::pipeline::picture

#endif
