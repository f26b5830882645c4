/// The balance term of the pose fit: the zero-moment point lies within the standing feet.
///                                                     docs/method.md, "Keypoint fit", "Without keypoints"
///
/// What it does not do: it ignores frames in which hands, knees or trunk are near the floor, flights, and the
/// body's angular momentum.
#pragma once

#include "fit/least_squares/bordered_band.h"
#include "fit/least_squares/contacts.h"
#include "fit/least_squares/fit_kinematics.h"

namespace mimicx::fit {

/// Adds the normal equations of the term at a state, with accelerations held fixed. Adds nothing for
/// `balance_frames` = 0.
/// @param motion, feet  kinematics and foot points of the state, [frames]
void add_balance(const FitProblem& problem, const Character& character,
                 const PerFrame<FrameKinematics>& motion, const PerFrame<FootPositions>& feet,
                 const Contacts& contacts, BorderedBand& system);

}  // namespace mimicx::fit
