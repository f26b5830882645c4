/// Keeps what touches the floor in its place, where our body's bones have other proportions than the
/// skeleton's.
///
/// Retargeting keeps the directions of the bones. Where thigh and shank have other lengths than the
/// skeleton's, or where the lengths that joint positions show change with the knee's angle, a bent leg then
/// ends elsewhere: standing feet hover, feet land late, kneeling knees float. This step bends each leg so
/// that its ankle is where the skeleton's is from the middle of the hips, and lowers or raises the pelvis so
/// that resting knees lie on the floor.
#pragma once

#include "import/landmarks.h"
#include "motion/clip.h"

namespace mimicx::import {

/// Whether the character's legs are in other proportions than those of the skeleton.
/// @param thigh, shank  of the skeleton, any unit
bool has_other_legs(const Character& character, double thigh, double shank);

/// @param frames     the skeleton's, z up, m
/// @param leg_ratio  the character's legs over the skeleton's
/// @param clip       the retargeted motion, the pelvis not yet on the floor
void keep_contacts(const Character& character, const PerFrame<Landmarks>& frames, double leg_ratio,
                   motion::Clip& clip);

}  // namespace mimicx::import
