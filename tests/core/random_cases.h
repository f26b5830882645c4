/// How many random cases a test tries.
#pragma once

#include <cstdlib>

namespace mimicx::test {

/// All of them in the full check (`tools/check --full` sets MIMICX_ALL_CASES), otherwise a tenth.
inline int random_cases(int all) { return std::getenv("MIMICX_ALL_CASES") != nullptr ? all : all / 10; }

}  // namespace mimicx::test
