/// PNG files without interlace: pictures of 8-bit RGB, animations of 8-bit RGBA.
///
/// Source: W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", its chapters on chunks,
/// filters, compression and animation. Every row is filtered by Paeth's predictor. The compression is zlib's:
/// equal pixels give equal bytes as long as the library is the same.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/image.h"

namespace mimicx::picture {

/// Files of ours say who made them, at byte kPngOpeningAt.
inline constexpr std::string_view kPngOpening{"tEXtSoftware\0mimicx", 19};
inline constexpr std::size_t kPngOpeningAt = 37;

std::string format_png(const render::Image& image);

/// An animation that grows frame by frame and is repeated for ever; every browser plays it, and what knows no
/// animations shows its first frame. Of a frame the rectangle is stored in which it differs from the one
/// before, and in it the pixels that differ.
class PngAnimation {
 public:
  /// @param image  of the size of the ones before
  /// @param milliseconds  how long it is shown, at most 65535
  void add(const render::Image& image, int milliseconds);
  /// The file of all frames; there is at least one.
  std::string finish() const;

 private:
  render::Image last_;
  std::string chunks_;  ///< of the frames
  int frames_ = 0;
  std::uint32_t next_ = 0;  ///< number of the next chunk of the animation
};

}  // namespace mimicx::picture
