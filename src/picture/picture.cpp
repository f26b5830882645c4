#include "picture/picture.h"

#include <cmath>

#include "core/file.h"
#include "core/parallel.h"
#include "picture/png.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/text.h"

namespace mimicx::picture {
namespace {

const render::Colour kInk(0.02F, 0.03F, 0.04F);
constexpr render::Pixel kPaper{255, 255, 255};
constexpr float kFaded = 0.55F;  ///< share of the background colour in a stroboscope's first moment

/// A single motion is blue. Of several motions the first, usually the input, is brown.
render::Colour colour_of(int motion, int count) {
  const List<render::Colour> colours = {
      {0.09F, 0.25F, 0.56F}, {0.48F, 0.23F, 0.10F}, {0.13F, 0.38F, 0.14F}, {0.36F, 0.13F, 0.42F}};
  if (count == 1) return colours[0];
  constexpr Array<int, 4> kOrder = {1, 0, 2, 3};
  return colours[kOrder[motion % 4]];
}

render::Image draw_cell(const List<PosedMotion>& motions, const Cell& cell, int threads) {
  const PosedMotion& motion = motions[cell.motion];
  const render::Colour colour = colour_of(cell.motion, motions.count());
  List<render::Solid> solids = scene_solids(motion);
  for (int k = 0; k < cell.moments.count(); ++k) {
    const float faded =
        cell.moments.count() == 1
            ? 0.0F
            : kFaded * (1.0F - static_cast<float>(k) / static_cast<float>(cell.moments.count() - 1));
    for (render::Solid& solid : solids_at(motion, motion.frame_at(cell.moments[k]),
                                          (1.0F - faded) * colour + faded * render::background()))
      solids.push_back(std::move(solid));
  }
  return render::draw(solids, cell.camera, cell.width, cell.height, threads);
}

std::string animation(const List<PosedMotion>& motions, const Layout& layout, double rate, int threads) {
  PngAnimation file;
  const auto shown_at = [&](int page) { return static_cast<int>(std::lround(1000.0 * page / rate)); };
  const int pages = layout.pages.count();
  List<render::Image> images(pages);
  parallel_chain(
      pages, threads, [&](int k, int) { images[k] = draw_page(motions, layout.pages[k], layout.size, 1); },
      [&](int k) {
        file.add(images[k], shown_at(k + 1) - shown_at(k));
        images[k] = {};
      });
  return file.finish();
}

}  // namespace

render::Image draw_page(const List<PosedMotion>& motions, const Page& page, const Size& size, int threads) {
  render::Image image(size.width, size.height, kPaper);
  const bool alone = page.cells.count() == 1;
  parallel_for(page.cells.count(), threads, [&](int k) {
    const Cell& cell = page.cells[k];
    render::paste(draw_cell(motions, cell, alone ? threads : 1), cell.x, cell.y, image);
  });
  for (const Note& note : page.notes)
    render::draw_text_within(note.text, {note.x, note.y, note.height}, note.width, kInk, image);
  return image;
}

void write_picture(const std::filesystem::path& path, const List<PosedMotion>& motions, const Layout& layout,
                   double rate, int threads) {
  write_file_atomically(path, layout.pages.count() > 1
                                  ? animation(motions, layout, rate, threads)
                                  : format_png(draw_page(motions, layout.pages[0], layout.size, threads)));
}

}  // namespace mimicx::picture
