/// Reads the bits of one type as another type of the same size.
#pragma once

namespace mimicx {

/// std::bit_cast, which some standard libraries lack that have the rest of C++20.
template <class To, class From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace mimicx
