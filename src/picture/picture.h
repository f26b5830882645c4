/// Draws the pages of a layout and writes them as PNG files.
#pragma once

#include <filesystem>

#include "picture/layout.h"
#include "render/image.h"

namespace mimicx::picture {

/// Draws a page. The pixels do not depend on the number of threads.
render::Image draw_page(const List<PosedMotion>& motions, const Page& page, const Size& size, int threads);

/// Writes the layout's page as PNG, or several pages as an animated PNG. @param rate  pages per second
/// @throws DataError when the file cannot be written
void write_picture(const std::filesystem::path& path, const List<PosedMotion>& motions, const Layout& layout,
                   double rate, int threads);

}  // namespace mimicx::picture
