/// Leads limbs that pass through the body around it.          docs/method.md, "Repairs of a reference"
///
/// Estimates let a hand go in at the front of the head and out at its back within some frames. A simulated
/// hand cannot; it is caught on the wrong side, and the body is bent until it falls. Separation of arms
/// (arm_separation.h) pushes each frame out on its nearest side, which is the front before the middle of the
/// passage and the back after it. So the side is chosen for the whole passage.
///
/// What it does not do: it does not find the true way of a limb that is hidden. It moves no limb of a
/// standing foot, and no trunk.
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

struct PassageReport {
  int passages = 0;                   ///< found
  int remaining = 0;                  ///< for which no way around was found
  int first_frame = 0;                ///< of the first one
  int limb_body = -1, obstacle = -1;  ///< bodies of the first one
  double moved = 0;                   ///< largest distance that a joint moved, m
};

/// A passage is a stretch of overlap of a limb with another part of the body in which the direction from that
/// part's axis to the limb's turns by more than 70° from one frame to the next, deep inside. Of eight ways
/// across the passage – or the way back, where the limb goes in and out on one side – the one is taken that
/// costs least: docs/method.md, "Repairs of a reference", (17), and what the limb's keypoints are worse off.
/// Keypoints count where the reference has them.
/// Changes only frames within half a second of a passage, and `poses` with them. Deterministic.
PassageReport lead_limbs_around(Reference& reference);

}  // namespace mimicx::motion
