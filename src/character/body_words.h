/// Bodies as messages name them. Files, columns and joint maps have `kBodyNames`.
#pragma once

#include <string>

namespace mimicx {

/// "left foot"
std::string body_in_words(int body);

}  // namespace mimicx
