/// The ways to linearise a control frame, behind one function.
#pragma once

#include "control/differences.h"

namespace mimicx::control {

enum class Derivatives {
  kColumns,   ///< central differences, one coordinate at a time
  kSmoothed,  ///< least squares over a neighbourhood
};

struct Linearisation {
  Derivatives derivatives = Derivatives::kColumns;
  DifferenceSteps steps;
};

/// F [122 × kMemory + system.controls()] at a point.
FrameMatrix linearise(const System& system, const FramePoint& point, const Linearisation& how);

}  // namespace mimicx::control
