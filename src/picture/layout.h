/// What stands where in a picture of motions, seen by which camera.
///
/// Several motions are shown at the same moments by the same cameras: they are the rows of a strip and of a
/// stroboscope, and stand beside each other in a still and in an animation. The camera stands still, but for
/// a strip's: from moment to moment it goes along with the middle of all pelvises, over the floor.
#pragma once

#include <optional>
#include <string>

#include "picture/moments.h"
#include "render/camera.h"

namespace mimicx::picture {

/// One moment; one room with many moments; many moments beside each other; a film.
enum class Kind { kStill, kStroboscope, kStrip, kAnimation };

struct Size {
  int width = 0, height = 0;  ///< pixels
};

struct PictureConfig {
  Kind kind = Kind::kStrip;
  /// Where the camera stands, degrees: 0 before the first body as it looks at first, 90 at its right side.
  double view = 45.0;
  List<double> at;            ///< moments to show, s; empty: evenly spread, of a still a telling one
  int moments = 8;            ///< of a strip and a stroboscope
  Stretch stretch{0.0, 1e9};  ///< moments are taken from it, s; cut to where all motions are
  std::optional<Size> size;   ///< of the whole picture; none: as large as the motion needs
  double rate = 30.0;         ///< pages per second of an animation
};

/// A part of a picture: one motion at some moments.
struct Cell {
  int motion;
  List<double> moments;  ///< s
  render::Camera camera;
  int x, y, width, height;  ///< pixels
};

/// A line of text. @see render::draw_text_within
struct Note {
  std::string text;
  double x, y, height, width;  ///< pixels
};

/// One picture; of an animation a frame.
struct Page {
  double time = 0;  ///< of its first moment, s
  List<Cell> cells;
  List<Note> notes;
};

struct Layout {
  Size size;
  List<double> moments;  ///< all that are shown, s
  List<Page> pages;      ///< one; of an animation as many as there are moments
};

/// Cells are at least this wide and high, pixels.
inline constexpr int kLeastCell = 16;

/// @throws std::invalid_argument for moments where not all motions are, and for a size that leaves cells no
/// room
Layout lay_out(const List<PosedMotion>& motions, const PictureConfig& config);

}  // namespace mimicx::picture
