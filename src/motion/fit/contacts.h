/// Feet that stand: what the keypoint fit decides anew before each step.
#pragma once

#include "motion/fit/kinematics.h"

namespace mimicx::motion::fit {

/// Which foot points stand in which frame: [frames][kFootPoints].
using Contacts = PerFrame<Array<bool, kFootPoints>>;

/// Foot points that are low and slow stand.
/// @param settled  the motion is on the floor already, and a low point is low over z = 0; else it is low over
///                 the floor of its own foot, a low percentile of that foot's heights
Contacts find_contacts(const PerFrame<FootPositions>& feet, double fps, bool settled);

}  // namespace mimicx::motion::fit
