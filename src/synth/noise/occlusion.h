/// Which points of a body the body itself hides from a camera.       docs/method.md, "Noise model", (13)
///
/// The body is its collision capsules. A joint lies inside its own limb and is seen all the same, so a point
/// counts as hidden where the ray from the eye to it runs through more of a capsule than one and a half of
/// its radius: a limb in front of it, or the trunk between the eye and a hip of the far side.
/// What it does not do: no furniture, no other people, no borders of the picture.
#pragma once

#include "character/character.h"

namespace mimicx::synth {

inline constexpr double kHidingDepth = 1.5;  ///< radii of a capsule that hide what is behind them

/// Length of the part of the segment from `eye` to `point` that lies inside a capsule, m.
/// @param a, b  ends of the capsule's axis, world, m
double length_inside(const Vector3d& eye, const Vector3d& point, const Vector3d& a, const Vector3d& b,
                     double radius);

/// @param point  world, m
bool is_hidden(const Character& character, const BodyPoses& poses, const Vector3d& eye,
               const Vector3d& point);

}  // namespace mimicx::synth
