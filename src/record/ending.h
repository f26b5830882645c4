/// How the work on a motion ended.
#pragma once

namespace mimicx::record {

enum class Ending {
  kNone,          ///< there was none: the input could not be used
  kBudget,        ///< all samples were spent
  kThreshold,     ///< a roll-out was good enough
  kStall,         ///< roll-outs no longer became better
  kLimitSeconds,  ///< the safety stop: the results depend on the machine's speed
  kFollowed,      ///< a plan that reaches the motion's end
  kLost,          ///< a plan that does not
};

}  // namespace mimicx::record
