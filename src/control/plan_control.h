/// How a caller accompanies a long computation.
#pragma once

#include <functional>

namespace mimicx::control {

/// None of it changes a byte of the result, `should_stop` aside.
struct PlanControl {
  int threads = 1;
  std::function<bool()> should_stop = {};                   ///< asked between windows; empty: never
  std::function<void(int done, int frames)> progress = {};  ///< frames that are settled; empty: nobody
};

}  // namespace mimicx::control
