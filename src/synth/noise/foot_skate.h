/// Feet that slip while they stand, as those of learned estimators.    docs/method.md, "Noise model", (8)
///
/// Feet in the air return to their true positions.
#pragma once

#include <cstdint>

#include "synth/noise/estimated_motion.h"

namespace mimicx::synth {

/// Horizontal slip of a foot, m. Its velocity is speed·S per axis while the foot stands; it decays with a
/// time constant that is short in the air.
PerFrame<Vector3d> drawn_slip(const PerFrame<bool>& standing, double speed, int ankle, std::uint64_t seed,
                              double fps);

/// Moves an ankle by bending hip and knee, as far as the leg reaches. The foot keeps its orientation in the
/// world, the knee its plane.
/// @param character  the body that moves  @param q  [22] of one frame, changed
void move_ankle(const Character& character, const Vector3d& shift, int ankle, PerBody<Quaterniond>& q);

/// Adds slip to both feet where they stand in the truth.
void skate(const Character& character, const PerFrame<BodyPoses>& truth, double speed, std::uint64_t seed,
           double fps, EstimatedMotion& motion);

}  // namespace mimicx::synth
