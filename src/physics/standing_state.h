/// A state to begin with.
#pragma once

#include "physics/data.h"

namespace mimicx::physics {

/// Upright at rest with bent knees and arms down, facing −y, the soles on the floor.
State<double> standing_state(const Character& character);

/// The PD target that holds the pose of a state.
Target<double> target_at(const State<double>& state);

}  // namespace mimicx::physics
