/// Draws what was laid out.
#pragma once

#include <filesystem>

#include "picture/layout.h"
#include "render/image.h"

namespace mimicx::picture {

/// The same pixels for any number of threads.
render::Image draw_page(const List<PosedMotion>& motions, const Page& page, const Size& size, int threads);

/// Writes the layout's one page, or its pages as an animation, as PNG. @param rate  pages per second
/// @throws DataError when the file cannot be written
void write_picture(const std::filesystem::path& path, const List<PosedMotion>& motions, const Layout& layout,
                   double rate, int threads);

}  // namespace mimicx::picture
