/// Bits: read as another type, and the arithmetic that decides them.
#pragma once

namespace mimicx {

/// The bits of a value as another type of the same size: std::bit_cast, which some standard libraries lack
/// that have the rest of C++20.
template <class To, class From>
constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// Builds of the same arithmetic give the same bits. The name is that of an instruction set, which fixes
/// fused operations and vector width, or "portable": the same bits on every machine (docs/porting.md). Runs
/// write it into their manifests.
#ifdef MIMICX_PORTABLE_ARITHMETIC
inline constexpr const char* kArithmetic = "portable";
#else
inline constexpr const char* kArithmetic = MIMICX_TARGET;
#endif

}  // namespace mimicx
