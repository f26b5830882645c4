/// Postures at random, for the kinds that are strung together (choreography.h).
#pragma once

#include "core/random.h"
#include "synth/plan_frame.h"

namespace mimicx::synth {

/// An arm anywhere in front of, above or beside the body.
ArmPosture random_arm(Random& random);

/// Pelvis, trunk, head and both arms at random on top of someone who stands. @param amount  0 none, 1 much
PlanFrame random_posture(Random& random, const PlanFrame& stand, double amount);

/// Hands in front of the chin, elbows low.
PlanFrame guard_posture(const PlanFrame& stand);

/// The arms held out for balance.
PlanFrame poised_posture(const PlanFrame& stand);

}  // namespace mimicx::synth
