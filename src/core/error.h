/// Errors the user can act on.
///
/// `DataError` is for bad data: a file, a place in it, what was expected and what was found, in one
/// line. A wrong argument of a function is `std::invalid_argument`, a programmer's slip is `assert`.
///
/// The rooms that a bare build has (docs/porting.md) say `raise(error)` instead of `throw error`.
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

#ifdef __cpp_exceptions
/// Throws it.
template <class Error>
[[noreturn]] void raise(const Error& error) {
  throw error;
}
#else
/// Told the message of an error in a build without exceptions; must not return. The program defines it.
[[noreturn]] void stop(const char* message);

/// Stops with its message.
template <class Error>
[[noreturn]] void raise(const Error& error) {
  stop(error.what());
}
#endif

}  // namespace mimicx
