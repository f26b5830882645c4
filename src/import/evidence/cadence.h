/// How often a walking body steps, which tells the length of its legs: people of all sizes walk alike, with
/// f √(L/g) ≈ 0.52 steps (f steps a second, leg L), after Hof, "Scaling gait data to body size" (1996).
#pragma once

#include <optional>

#include "import/landmarks.h"

namespace mimicx::import {

/// Length of the leg, m, that walks with these steps; none where the body does not walk. People walk more
/// slowly as they please, so that legs may be shorter, hardly longer.
/// @param poses  any unit @param up  unit vector @param fps  of the file
std::optional<double> walking_leg(const PerFrame<Landmarks>& poses, const Vector3d& up, double fps);

}  // namespace mimicx::import
