/// Short labels in an alphabet of strokes (glyphs.h), drawn with round ends and soft edges.
#pragma once

#include <string>

#include "render/image.h"

namespace mimicx::render {

/// Width of a line of text, pixels. @param height  of capital letters, pixels
double text_width(const std::string& text, double height);

/// Draws a line of text. What reaches over the edge of the image is cut off.
/// @param x, y  the left end of the baseline, pixels
void draw_text(const std::string& text, double x, double y, double height, const Colour& ink, Image& image);

/// Draws it, cutting off as much of its beginning as is needed to fit `width`; dots stand for what is gone.
/// (The end of a file's name says more than its folder.)
void draw_text_within(const std::string& text, double x, double y, double height, double width,
                      const Colour& ink, Image& image);

}  // namespace mimicx::render
