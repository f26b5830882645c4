/// Gait: pelvis, trunk and arms that follow the feet.
///
/// What it does not do: it does not decide where the feet go (FootSwing, synth/footsteps.h).
#pragma once

#include "core/units.h"
#include "synth/footsteps.h"

namespace mimicx::synth {

/// Amplitudes of a gait.
struct GaitStyle {
  double arm_swing, pelvis_turn, pelvis_drop, trunk_lean;  ///< rad
};
/// Of a person who hardly walks.
inline constexpr GaitStyle kQuiet = {0.0, 0.0, 2.0 * kDegree, 0.0};

/// Adds to a plan the motion of pelvis, trunk, arms and height that belongs to its steps. The arms swing with
/// the distance between the feet.
/// @param stride  distance of the feet in a full step, m
/// @param plan    has feet and heading, and posture and height of standing
void follow_feet(const Character& character, const GaitStyle& style, double stride, const FeetTracks& feet,
                 PerFrame<PlanFrame>& plan);

/// Turns the pelvis to the mean direction of the feet, smoothed over the steps. @param plan  has its feet
void face_along_feet(PerFrame<PlanFrame>& plan);

}  // namespace mimicx::synth
