/// The linear model of a control frame: derivatives of the nominal motion, by the chain rule through every
/// step.
#pragma once

#include "control/analytic/analytic.h"
#include "control/differences.h"

namespace mimicx::control {

/// Buffers of one worker; large, reuse them from frame to frame. Their contents do not matter.
struct LinearisationScratch {
  FrameScratch<P> frame;
  FrameDerivative<P> derivative;
};

/// F [122 × kMemory + system.controls()] at a point; zero where the motion goes wrong in the simulator.
FrameMatrix linearise(const System& system, const FramePoint& point, LinearisationScratch& scratch);

}  // namespace mimicx::control
