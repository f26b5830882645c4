/// What walking kinds have in common: the body follows the feet.
///
/// What it does not do: decide where the feet go (FootSwing, synth/footsteps.h).
#pragma once

#include "core/units.h"
#include "synth/footsteps.h"

namespace mimicx::synth {

/// How a gait looks, beyond where the feet go.
struct GaitStyle {
  double arm_swing, pelvis_turn, pelvis_drop, trunk_lean;  ///< rad
};
/// Of somebody who stands and does something else: next to nothing.
inline constexpr GaitStyle kQuiet = {0.0, 0.0, 2.0 * kDegree, 0.0};

/// Pelvis, trunk, arms and height follow the feet: what swings the arms is which foot is ahead.
/// @param plan  feet and heading set; posture and height those of standing
/// @param stride  distance of the feet in a full step, m
void follow_feet(const Character& character, const GaitStyle& style, double stride, const FeetTracks& feet,
                 PerFrame<PlanFrame>& plan);

/// The pelvis faces where the feet point on average, without their steps. @param plan  feet set
void face_along_feet(PerFrame<PlanFrame>& plan);

}  // namespace mimicx::synth
