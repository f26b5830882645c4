#include "pipeline/picture/webp.h"

#include <stdexcept>

#include "core/error.h"

#ifdef MIMICX_WITH_WEBP
#include <webp/encode.h>
#include <webp/mux.h>
#endif

namespace mimicx::pipeline::picture {

#ifdef MIMICX_WITH_WEBP

namespace {

constexpr float kQuality = 82.0F;  ///< of 100
constexpr int kMethod = 4;         ///< how long it tries, of 0 to 6

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("libwebp: ") + what + " failed");
}

}  // namespace

struct WebpAnimation::Encoder {
  Encoder(int width, int height) {
    WebPAnimEncoderOptions options;
    if (!WebPAnimEncoderOptionsInit(&options)) fail("WebPAnimEncoderOptionsInit");
    encoder.reset(WebPAnimEncoderNew(width, height, &options));
    if (!encoder) fail("WebPAnimEncoderNew");
  }
  std::unique_ptr<WebPAnimEncoder, void (*)(WebPAnimEncoder*)> encoder{nullptr, WebPAnimEncoderDelete};
};

void require_webp(const std::string&) {}

WebpAnimation::WebpAnimation(int width, int height) : encoder_(std::make_unique<Encoder>(width, height)) {}
WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::add(const render::Image& image, int milliseconds) {
  WebPConfig config;
  WebPPicture picture;
  if (!WebPConfigPreset(&config, WEBP_PRESET_DRAWING, kQuality) || !WebPPictureInit(&picture))
    fail("initialising");
  config.method = kMethod;
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  static_assert(sizeof(render::Pixel) == 3);
  const bool good = WebPPictureImportRGB(&picture, reinterpret_cast<const std::uint8_t*>(image.pixels.data()),
                                         3 * image.width) &&
                    WebPAnimEncoderAdd(encoder_->encoder.get(), &picture, milliseconds, &config);
  WebPPictureFree(&picture);
  if (!good) fail("WebPAnimEncoderAdd");
}

std::string WebpAnimation::finish(int milliseconds) {
  WebPData frames, file;
  WebPDataInit(&frames);
  WebPDataInit(&file);
  const auto text = [](const WebPData& data) {
    return std::string(reinterpret_cast<const char*>(data.bytes), data.size);
  };
  if (!WebPAnimEncoderAdd(encoder_->encoder.get(), nullptr, milliseconds, nullptr) ||
      !WebPAnimEncoderAssemble(encoder_->encoder.get(), &frames))
    fail("WebPAnimEncoderAssemble");
  const std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux(WebPMuxCreate(&frames, 1), WebPMuxDelete);
  WebPDataClear(&frames);
  const WebPData maker{reinterpret_cast<const std::uint8_t*>(kWebpEnding.data()), kWebpEnding.size()};
  if (!mux || WebPMuxSetChunk(mux.get(), "XMP ", &maker, 1) != WEBP_MUX_OK ||
      WebPMuxAssemble(mux.get(), &file) != WEBP_MUX_OK)
    fail("WebPMuxAssemble");
  std::string bytes = text(file);
  WebPDataClear(&file);
  return bytes;
}

#else

struct WebpAnimation::Encoder {};

void require_webp(const std::string& path) {
  throw DataError(path, "", "a build with libwebp (Debian: libwebp-dev)",
                  "one without it, which writes .png alone");
}

WebpAnimation::WebpAnimation(int, int) { require_webp("animation"); }
WebpAnimation::~WebpAnimation() = default;
void WebpAnimation::add(const render::Image&, int) {}
std::string WebpAnimation::finish(int) { return {}; }

#endif

}  // namespace mimicx::pipeline::picture
