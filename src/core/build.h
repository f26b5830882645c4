/// What this program was built for.
#pragma once

namespace mimicx {

/// Builds of the same arithmetic give the same bits: that of an instruction set, with its fused operations
/// and its width, or "portable", the same on every machine (docs/porting.md). Runs write it into their
/// manifests.
#ifdef MIMICX_PORTABLE_ARITHMETIC
inline constexpr const char* kArithmetic = "portable";
#else
inline constexpr const char* kArithmetic = MIMICX_TARGET;
#endif

}  // namespace mimicx
