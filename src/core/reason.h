/// What an error says to a user.
#pragma once

#include <exception>
#include <new>
#include <string>

namespace mimicx {

/// The message of an error; the standard library's own names of errors in words.
inline std::string reason_of(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "not enough memory" : error.what();
}

}  // namespace mimicx
