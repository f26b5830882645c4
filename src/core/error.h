/// Errors the user can act on.
///
/// `DataError` is for bad data: a file, a place in it, what was expected and what was found, in one
/// line. A wrong argument of a function is `std::invalid_argument`, a programmer's slip is `assert`.
#pragma once

#include <stdexcept>
#include <string>

namespace mimicx {

class DataError : public std::runtime_error {
 public:
  /// @param path      the file, or a short name of the data where there is no file
  /// @param place     line, key or member inside it; may be empty
  /// @param expected  what was expected there
  /// @param found     what was found instead
  DataError(const std::string& path, const std::string& place, const std::string& expected,
            const std::string& found)
      : std::runtime_error(path + (place.empty() ? "" : ": " + place) + ": expected " + expected +
                           ", found " + found) {}
};

}  // namespace mimicx
