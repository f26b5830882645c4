/// How many random cases a test tries.
#pragma once

#include <cstdlib>

namespace mimicx::test {

/// All of them in the full check (`tools/check --full` sets MIMICX_ALL_CASES), otherwise a tenth.
inline int random_cases(int all) {
  static const bool all_of_them = std::getenv("MIMICX_ALL_CASES") != nullptr;
  return all_of_them ? all : all / 10;
}

}  // namespace mimicx::test
