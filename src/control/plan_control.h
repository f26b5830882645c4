/// Threads, progress and interruption of a long computation.
#pragma once

#include <functional>

namespace mimicx::control {

/// Only `should_stop` changes the result.
struct PlanControl {
  int threads = 1;
  std::function<bool()> should_stop = {};                   ///< called between windows; may be empty
  std::function<void(int done, int frames)> progress = {};  ///< after a window is committed; may be empty
};

}  // namespace mimicx::control
