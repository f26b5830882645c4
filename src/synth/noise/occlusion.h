/// Self-occlusion: the points of a body that the body hides from a camera.  docs/method.md, "Noise model",
/// (14)
///
/// The body is represented by its collision capsules. A joint lies inside its own limb and is visible anyway,
/// so a point counts as hidden only where the ray from the eye to it passes through more than one and a half
/// radii of a capsule: a limb in front of it, or the trunk in front of a hip on the far side. What it does
/// not do: no furniture, no other people, no borders of the picture.
#pragma once

#include "character/character.h"

namespace mimicx::synth {

inline constexpr double kHidingDepth = 1.5;  ///< length inside a capsule that hides a point, in its radii

/// Length of the part of the segment from `eye` to `point` that lies inside a capsule, m.
/// @param a, b  ends of the capsule's axis, world, m
double length_inside(const Vector3d& eye, const Vector3d& point, const Vector3d& a, const Vector3d& b,
                     double radius);

/// @param point  world, m
bool is_hidden(const Character& character, const BodyPoses& poses, const Vector3d& eye,
               const Vector3d& point);

}  // namespace mimicx::synth
