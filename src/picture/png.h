/// Writes PNG files without interlace: pictures in 8-bit RGB, animations in 8-bit RGBA.
///
/// Source: W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", its chapters on chunks,
/// filters, compression and animation. Every row is filtered by Paeth's predictor. The compression is zlib's:
/// equal pixels give equal bytes with the same version of zlib.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/image.h"

namespace mimicx::picture {

/// Text chunk at byte kPngOpeningAt by which the program recognises its own files.
inline constexpr std::string_view kPngOpening{"tEXtSoftware\0mimicx", 19};
inline constexpr std::size_t kPngOpeningAt = 37;

std::string format_png(const render::Image& image);

/// Builds an animation frame by frame. It repeats for ever; browsers play it, and other programs show its
/// first frame. Of a frame only the changed rectangle is stored, in which unchanged pixels are transparent.
class PngAnimation {
 public:
  /// Appends a frame. @param image  has the size of earlier ones
  /// @param milliseconds  its duration, at most 65535
  void add(const render::Image& image, int milliseconds);
  /// The bytes of the file. There must be at least one frame.
  std::string finish() const;

 private:
  render::Image last_;
  std::string chunks_;  ///< of the frames
  int frames_ = 0;
  std::uint32_t next_ = 0;  ///< number of the next chunk of the animation
};

}  // namespace mimicx::picture
