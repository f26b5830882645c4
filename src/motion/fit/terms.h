/// The terms of the keypoint fit's cost and their normal equations.  docs/method.md, "Keypoint fit", (7)
#pragma once

#include "motion/fit/contacts.h"
#include "motion/fit/kinematics.h"
#include "motion/fit/solver.h"

namespace mimicx::motion::fit {

/// Normal equations of all terms at a state, robust weights and contacts held fixed.
/// @param motion, feet  kinematics and foot points of the state, [frames]
/// @return left: half the Gauss-Newton Hessian JᵀJ; right: minus half the gradient, −Jᵀr
BorderedBand linearise(const FitProblem& problem, const FitState& state,
                       const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                       const Contacts& contacts);

}  // namespace mimicx::motion::fit
