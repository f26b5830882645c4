/// The balance term of a fit of poses alone: over the feet that stand, the zero-moment point lies within
/// them.
///                                                     docs/method.md, "Keypoint fit", "Without keypoints"
///
/// What it does not do: it says nothing of frames in which hands, knees or trunk are near the floor, nor of
/// flights, and nothing of the body's angular momentum.
#pragma once

#include "fit/least_squares/bordered_band.h"
#include "fit/least_squares/contacts.h"
#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Adds the normal equations of the term at a state; accelerations are held fixed. `balance_frames` = 0:
/// nothing.
/// @param motion, feet  kinematics and foot points of the state, [frames]
void add_balance(const FitProblem& problem, const Character& character,
                 const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                 const Contacts& contacts, BorderedBand& system);

}  // namespace mimicx::fit
