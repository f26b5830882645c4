/// What a file is that is no motion, in words, with what to do.
#pragma once

#include <string>

namespace mimicx::import {

/// @param bytes  of the whole file, or its beginning
std::string content_in_words(const std::string& bytes);

}  // namespace mimicx::import
