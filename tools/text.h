/// Words for people: joined, wrapped, and what somebody may have meant who mistyped one.
#pragma once

#include <string>
#include <vector>

namespace mimicx::tools {

std::string joined(const std::vector<std::string>& words, const std::string& between);

/// The text with line breaks where the next word would stand past `width`.
std::string wrapped(const std::string& text, std::size_t width);

/// The fewest letters to add, drop, exchange, or swap with their neighbour, to make one word the other.
int edits_between(const std::string& a, const std::string& b);

/// The word that needs the fewest edits, the first of several; empty where more than a third of the letters
/// would have to change.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

}  // namespace mimicx::tools
