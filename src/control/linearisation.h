/// The ways to linearise a control frame, behind one function.
#pragma once

#include "control/analytic/analytic.h"
#include "control/differences.h"

namespace mimicx::control {

enum class Derivatives {
  kAnalytic,  ///< of the nominal motion, by the chain rule through every step
  kColumns,   ///< central differences, one coordinate at a time
  kSmoothed,  ///< least squares over a neighbourhood
};

struct Linearisation {
  Derivatives derivatives = Derivatives::kAnalytic;
  DifferenceSteps steps;  ///< of the differences
};

/// What one worker needs; large, to be kept from frame to frame. Its contents do not matter.
struct LinearisationScratch {
  FrameScratch<P> frame;
  FrameDerivative<P> derivative;
};

/// F [122 × kMemory + system.controls()] at a point.
FrameMatrix linearise(const System& system, const FramePoint& point, const Linearisation& how,
                      LinearisationScratch& scratch);

}  // namespace mimicx::control
