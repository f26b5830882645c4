/// The terms of the keypoint fit's cost and their normal equations.  docs/method.md, "Keypoint fit", (7)
#pragma once

#include "fit/least_squares/bordered_band.h"
#include "fit/least_squares/contacts.h"
#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// A system and its border. The border refers to the arguments of `linearise`, which must outlive it.
struct NormalEquations {
  BorderedBand band;
  Border border;
};

/// Normal equations of all terms at a state, robust weights and contacts held fixed.
/// @param motion, feet  kinematics and foot points of the state, [frames]
/// @return left: half the Gauss-Newton Hessian JᵀJ; right: minus half the gradient, −Jᵀr
NormalEquations linearise(const FitProblem& problem, const FitState& state,
                          const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                          const Contacts& contacts);

}  // namespace mimicx::fit
