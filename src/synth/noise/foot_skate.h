/// Feet that slip while they stand, as learned estimators leave them.       docs/method.md, "Noise model",
/// (8)
///
/// What it does not do: nothing for feet in the air, which return to where they belong.
#pragma once

#include <cstdint>

#include "synth/noise/estimated_motion.h"

namespace mimicx::synth {

/// How far a foot has slipped, horizontally, m: speed·S per axis while it stands, and back with a time
/// constant that is short in the air.
PerFrame<Vector3d> drawn_slip(const PerFrame<bool>& standing, double speed, int ankle, std::uint64_t seed,
                              double fps);

/// Moves an ankle by bending hip and knee; the foot keeps its orientation in the world, the knee its plane.
/// As far as the leg reaches.
/// @param character  the body that moves  @param q  [22] of one frame, changed
void move_ankle(const Character& character, const Vector3d& shift, int ankle, PerBody<Quaterniond>& q);

/// Lets both feet slip where they stand in the truth.
void skate(const Character& character, const PerFrame<BodyPoses>& truth, double speed, std::uint64_t seed,
           double fps, EstimatedMotion& motion);

}  // namespace mimicx::synth
