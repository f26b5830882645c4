/// Layout of a picture of motions: cells, cameras and notes.
///
/// Several motions are shown at the same moments by the same cameras, as rows of a strip or a stroboscope, or
/// side by side in a still or an animation. The camera does not move, except in a strip: from moment to
/// moment it follows the horizontal position of the mean of all pelvises.
#pragma once

#include <optional>
#include <string>

#include "picture/moments.h"
#include "render/camera.h"

namespace mimicx::picture {

/// One moment; many moments in one scene; many moments side by side; an animation.
enum class Kind { kStill, kStroboscope, kStrip, kAnimation };

struct Size {
  int width = 0, height = 0;  ///< pixels
};

struct PictureConfig {
  Kind kind = Kind::kStrip;
  /// Direction of the camera, degrees: 0 in front of the first body in its first pose, 90 at its right side.
  double view = 45.0;
  List<double> at;             ///< moments to show, s; empty: evenly spaced, or `telling_moment` for a still
  int moments = 8;             ///< number of moments of a strip or a stroboscope
  TimeSpan stretch{0.0, 1e9};  ///< time range of the moments, s; cut to the range that all motions have
  std::optional<Size> size;    ///< of the whole picture; none: chosen by the motion
  double rate = 30.0;          ///< pages per second of an animation
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

/// One picture, or one frame of an animation.
struct Page {
  double time = 0;  ///< of its first moment, s
  List<Cell> cells;
  List<Note> notes;
};

struct Layout {
  Size size;
  List<double> moments;  ///< all that are shown, s, in the order of time
  List<Page> pages;      ///< one; for an animation one per moment
};

/// Smallest width and height of a cell, pixels.
inline constexpr int kLeastCell = 16;

/// @throws std::invalid_argument for moments outside of any motion, and for a size that is too small for the
/// cells
Layout lay_out(const List<PosedMotion>& motions, const PictureConfig& config);

}  // namespace mimicx::picture
