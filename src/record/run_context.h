/// What a run gets from its caller: where to print progress and messages, and when to stop.
#pragma once

#include <functional>
#include <ostream>

#include "record/progress.h"

namespace mimicx::record {

struct RunContext {
  Progress& progress;
  std::ostream& messages;             ///< one line per input, warnings
  std::function<bool()> should_stop;  ///< true: write a checkpoint and return
};

enum class RunOutcome { kAllGood, kSomeFailed, kInterrupted };

}  // namespace mimicx::record
