/// A stroke font for labels: the printable characters of ASCII.
///
/// A glyph is a string of strokes, separated by blanks. A stroke is a list of points, each of two digits: x,
/// to the right from 0, and y, downward: 0 is the height of capitals, 2 that of small letters, 6 the
/// baseline, 8 the depth of descenders. A stroke of one point is a dot.
#pragma once

#include <string_view>

namespace mimicx::render {

inline constexpr int kCapitalHeight = 6;

bool has_glyph(char c);

/// Strokes of a character; those of '?' for a character that the font lacks.
std::string_view glyph(char c);

/// Advance width: from a character's left edge to the next character's, in the units of the glyphs.
int advance(char c);

}  // namespace mimicx::render
