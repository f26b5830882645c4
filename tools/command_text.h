/// Text for the terminal: joining, wrapping, and the nearest word to a mistyped one.
#pragma once

#include <string>
#include <vector>

namespace mimicx::tools {

std::string joined(const std::vector<std::string>& words, const std::string& between);

/// The text with line breaks, so that no word ends after column `width`.
std::string wrapped(const std::string& text, std::size_t width);

/// The edit distance: fewest insertions, deletions, replacements and swaps of neighbouring letters that turn
/// one word into the other.
int edits_between(const std::string& a, const std::string& b);

/// The word with the fewest edits, the first of several; empty if more than a third of the letters would
/// change.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

}  // namespace mimicx::tools
