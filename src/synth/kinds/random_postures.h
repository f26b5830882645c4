/// Random postures for the kinds that are built by a Choreography (choreography.h).
#pragma once

#include "core/random.h"
#include "synth/plan_frame.h"

namespace mimicx::synth {

/// A random arm posture in front of, above or beside the body.
ArmPosture random_arm(Random& random);

/// Random pelvis, trunk, head and arms, added to a standing posture. @param amount  0: none, 1: much
PlanFrame random_posture(Random& random, const PlanFrame& stand, double amount);

/// Hands in front of the chin, elbows low.
PlanFrame guard_posture(const PlanFrame& stand);

/// The arms held out for balance.
PlanFrame poised_posture(const PlanFrame& stand);

}  // namespace mimicx::synth
