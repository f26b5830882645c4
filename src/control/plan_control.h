/// How a caller watches a long computation, and stops it.
#pragma once

#include <functional>

namespace mimicx::control {

/// Only `should_stop` can change the result.
struct PlanControl {
  int threads = 1;
  std::function<bool()> should_stop = {};                   ///< asked between windows; may be empty
  std::function<void(int done, int frames)> progress = {};  ///< of the frames that are settled; may be empty
};

}  // namespace mimicx::control
