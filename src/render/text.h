/// Short labels in a stroke font (glyphs.h), with round ends and antialiased edges.
#pragma once

#include <string>

#include "render/image.h"

namespace mimicx::render {

/// A text as it is drawn: with a '?' for every letter that the font lacks. @param text  UTF-8
std::string in_font(const std::string& text);

/// Width of a line of text, pixels. @param height  of capital letters, pixels
double text_width(const std::string& text, double height);

/// Place and size of a line of text, pixels.
struct TextPlace {
  double x, y;    ///< the left end of the baseline
  double height;  ///< of capital letters
};

/// Draws a line of text. Parts beyond the edge of the image are cut off.
void draw_text(const std::string& text, const TextPlace& place, const Colour& ink, Image& image);

/// Draws a line of at most `width` pixels: dots replace as much of the beginning as does not fit. (The end of
/// a file's name says more than its folder.)
void draw_text_within(const std::string& text, const TextPlace& place, double width, const Colour& ink,
                      Image& image);

}  // namespace mimicx::render
