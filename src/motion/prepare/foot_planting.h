/// Planting of the feet: a standing foot becomes one place on the floor.        docs/method.md, "Repairs"
///
/// References hover over the floor by millimetres to centimetres and slide on it. A simulated body that
/// follows them gets no support where it needs it, touches down late, and slides itself. So the legs and the
/// place of the pelvis are corrected, over the whole motion at once, until every standing point of the soles
/// (stance.h) is on the floor and stays there, no point of the legs is below it, no point of the soles is in
/// the side of a box, no joint of the legs is beyond its range, points that come down brake before they
/// touch, and the corrections are small and smooth.
///
/// What it does not do: it does not decide who stands (stance.h), and does not change the trunk's rotation,
/// arms and head.
#pragma once

#include "motion/prepare/stance.h"

namespace mimicx::motion {

/// Corrects `frames` and `poses`. @param stance  [frames] (stance.h) @return largest distance that a joint
/// moved, m
double plant_feet(const PerFrame<Stance>& stance, Reference& reference);

}  // namespace mimicx::motion
