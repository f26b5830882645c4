#include "character/body_words.h"

#include <algorithm>

#include "character/bodies.h"

namespace mimicx {

std::string body_in_words(int body) {
  std::string words(kBodyNames[body]);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace mimicx
