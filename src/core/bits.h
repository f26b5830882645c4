/// The bits of one type read as another of the same size.
#pragma once

namespace mimicx {

/// As std::bit_cast, which not every standard library has that knows the rest of C++20.
template <class To, class From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

}  // namespace mimicx
