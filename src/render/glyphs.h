/// The alphabet of labels: the printable characters of ASCII as strokes, in the manner of a pen plotter.
///
/// A glyph is written as its strokes, separated by blanks; a stroke as points of two digits, x and y. x grows
/// to the right from 0; y grows downward: 0 is the height of capitals, 2 that of small letters, 6 the
/// baseline, 8 the depth of descenders. A stroke of one point is a dot.
#pragma once

#include <string_view>

namespace mimicx::render {

inline constexpr int kCapitalHeight = 6;

/// Strokes of a character; those of '?' for one that is not in the alphabet.
std::string_view glyph(char c);

/// How far the next character's left edge stands behind this one's, in the units of the glyphs.
int advance(char c);

}  // namespace mimicx::render
