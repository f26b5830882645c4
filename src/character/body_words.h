/// Names of bodies in messages. Files, columns and joint maps use `kBodyNames`.
#pragma once

#include <string>

namespace mimicx {

/// "left foot"
std::string body_in_words(int body);

}  // namespace mimicx
