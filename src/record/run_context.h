/// The world around a run: where it tells how far it is, and when it is asked to stop.
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
