/// Says what a file contains that is no motion, and what the user can do with it.
#pragma once

#include <string>

namespace mimicx::import {

/// @param bytes  of the whole file, or its beginning
std::string content_in_words(const std::string& bytes);

}  // namespace mimicx::import
