/// Errors that the user can act on.
///
/// `DataError` reports bad data: file, place in it, what was expected and what was found, in one line. A
/// wrong argument of a function is `std::invalid_argument`, a programming error is an `assert`.
///
/// Rooms that are part of a bare build (docs/porting.md) call `raise(error)` instead of `throw error`.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#ifdef __cpp_exceptions
#include <filesystem>
#endif

namespace mimicx {

/// A file's name for a message of one line: line breaks become '?'. (What is printed escapes the other
/// control characters.)
inline std::string on_one_line(std::string name) {
  for (char& c : name)
    if (c == '\n' || c == '\r') c = '?';
  return name;
}

class DataError : public std::runtime_error {
 public:
  /// @param path      the file, or a short name of the data where there is no file
  /// @param place     line, key or member inside it; may be empty
  /// @param expected  what was expected there
  /// @param found     what was found instead
  DataError(const std::string& path, const std::string& place, const std::string& expected,
            const std::string& found)
      : std::runtime_error(on_one_line(path) + (place.empty() ? "" : ": " + place) + ": expected " +
                           expected + ", found " + found) {}
};

#ifdef __cpp_exceptions
/// Throws it.
template <class Error>
[[noreturn]] void raise(const Error& error) {
  throw error;
}

/// What an error says to a user: its message; the standard library's own names of errors in words.
inline std::string reason_of(const std::exception& error) {
  if (const auto* of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return of_file->path1().string() + ": " + of_file->code().message();
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "not enough memory" : error.what();
}
#else
/// Called with the message of an error in a build without exceptions. The program defines it; it must not
/// return.
[[noreturn]] void stop(const char* message);

/// Calls `stop` with its message.
template <class Error>
[[noreturn]] void raise(const Error& error) {
  stop(error.what());
}
#endif

}  // namespace mimicx
