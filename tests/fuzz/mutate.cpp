#include <algorithm>
#include <array>
#include <string_view>

#include "core/random.h"
#include "fuzz/driver.h"

namespace mimicx::fuzz {
namespace {

constexpr std::size_t kMaxLength = 1 << 16;

/// Words that readers often trust: counts, numbers at the edge of their type, structure, bytes outside
/// ASCII.
constexpr std::array<std::string_view, 20> kWords = {
    "nan",      "inf", "-1", "0", "1e999", "-1e-999", "2147483647", "4294967296", "18446744073709551616",
    "{",        "}",   "[",  "]", "\"",    ",",       "\r\n",       "\t",         "\xff\xfe",
    "\xe2\x82", " "};

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : random.below(static_cast<std::uint32_t>(n));
}

void edit(Random& random, const std::vector<std::string>& seeds, std::string& text) {
  const std::size_t at = below(random, text.size() + 1);
  const std::size_t length = below(random, std::min<std::size_t>(text.size() - at, 64) + 1);
  switch (random.below(8)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random.below(256));
      break;
    case 1:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
      break;
    case 2:
      text.insert(at, 1, static_cast<char>(random.below(256)));
      break;
    case 3:
      text.erase(at, length);
      break;
    case 4:
      text.insert(at, text.substr(at, length));
      break;
    case 5:
      text.insert(at, kWords[below(random, kWords.size())]);
      break;
    case 6: {
      const std::string& other = seeds[below(random, seeds.size())];
      const std::size_t from = below(random, other.size() + 1);
      text.insert(at, other.substr(from, below(random, 256)));
      break;
    }
    default:
      if (random.below(4) == 0) text.resize(at);  // a truncated file; rare: little remains to be read
      break;
  }
}

}  // namespace

std::string mutated_input(const std::vector<std::string>& seeds, std::uint64_t seed, std::uint64_t k) {
  Random random(seed, {0x66757a7a, k});
  std::string text = seeds[below(random, seeds.size())];
  for (std::uint32_t edits = 1 + random.below(8); edits > 0; --edits) edit(random, seeds, text);
  if (text.size() > kMaxLength) text.resize(kMaxLength);
  return text;
}

}  // namespace mimicx::fuzz
