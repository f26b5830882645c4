/// PNG files: 8-bit RGB without interlace.
///
/// Source: W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", its chapters on
/// chunks, filters and compression. Every row is filtered by Paeth's predictor. The compression is zlib's:
/// equal pixels give equal bytes as long as the library is the same.
#pragma once

#include <string>
#include <string_view>

#include "render/image.h"

namespace mimicx::pipeline::picture {

/// Files of ours say who made them, at byte kPngOpeningAt.
inline constexpr std::string_view kPngOpening{"tEXtSoftware\0mimicx", 19};
inline constexpr std::size_t kPngOpeningAt = 37;

std::string format_png(const render::Image& image);

}  // namespace mimicx::pipeline::picture
