/// Animated WebP files, which every browser plays, by libwebp.
///
/// Lossy, at a quality at which no difference is seen. The encoder is one thread's work: equal frames give
/// equal bytes as long as the library is the same. A build without libwebp says so when it is asked.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "render/image.h"

namespace mimicx::pipeline::picture {

/// Files of ours end with this: metadata (XMP) that says who made them.
inline constexpr std::string_view kWebpEnding =
    "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
    "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
    "<rdf:Description xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" xmp:CreatorTool=\"mimicx\"/></rdf:RDF>"
    "</x:xmpmeta>\n";
static_assert(kWebpEnding.size() % 2 == 0, "chunks of odd length would have a byte behind them");

/// Longest edge of a picture in this format, pixels.
inline constexpr int kWebpLimit = 16383;

/// @throws DataError where this build has no libwebp
void require_webp(const std::string& path);

/// An animation that grows frame by frame and runs for ever.
class WebpAnimation {
 public:
  WebpAnimation(int width, int height);
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;
  ~WebpAnimation();

  /// @param milliseconds  when it is shown, from the start on; later than the one before
  void add(const render::Image& image, int milliseconds);
  /// The file. @param milliseconds  when the last frame ends
  std::string finish(int milliseconds);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace mimicx::pipeline::picture
