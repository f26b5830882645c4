/// Brings joints that are beyond their anatomical ranges inside them.
///                                                          docs/method.md, "Repairs of a reference"
///
/// Beyond a range the simulator pushes back with thousands of N·m/rad, so a body that starts there is thrown,
/// and one that follows a reference there works against its own joints.
///
/// What it does not do: hips and shoulders have hinges below them, so their correction moves the limb; feet
/// are put back by foot_planting.h.
#pragma once

#include "motion/reference.h"

namespace mimicx::motion {

/// What was beyond the ranges (character/joint_range.h).
struct RangeReport {
  int frames = 0;       ///< with at least one joint beyond its range
  int body = -1;        ///< the joint that was farthest beyond
  double farthest = 0;  ///< its distance, rad
};

/// Turns joints into their ranges, from the pelvis outwards. What a joint cannot do is left to the joints
/// below it: their bodies keep their orientations in the world, unless the joint is a hinge. Only frames
/// within a third of a second of a joint beyond its range change. It minimises, joint by joint,
///
///     Σ_t max(0, d_t + d₀)²/σ_d²  +  Σ_t ‖c_t‖²/σ_c²  +  Σ_t ‖c_{t+1} − 2 c_t + c_{t−1}‖²/σ_b²
///
/// by Gauss–Newton, with c_t the joint's turn, q exp(c), d_t its distance beyond the range, and d₀ a margin.
/// What is still outside goes to the surface. `poses` are not updated.
RangeReport turn_into_ranges(Reference& reference);

}  // namespace mimicx::motion
