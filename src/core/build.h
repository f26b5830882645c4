/// The arithmetic that this program was built with.
#pragma once

namespace mimicx {

/// Builds of the same arithmetic give the same bits. The name is that of an instruction set, which fixes
/// fused operations and vector width, or "portable": the same bits on every machine (docs/porting.md). Runs
/// write it into their manifests.
#ifdef MIMICX_PORTABLE_ARITHMETIC
inline constexpr const char* kArithmetic = "portable";
#else
inline constexpr const char* kArithmetic = MIMICX_TARGET;
#endif

}  // namespace mimicx
