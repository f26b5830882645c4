/// Whether a skeleton's left and right are exchanged: of a file in mirrored axes, or with wrong names.
///
/// The direction in which the body faces follows from left and right; toes point in it and knees bend in it.
#pragma once

#include "import/landmarks.h"
#include "motion/clip.h"

namespace mimicx::import {

struct SidesDecision {
  double toes = 0.0;  ///< mean component of ankle → toes forward, −1 to 1; 0 without toes
  double knees =
      0.0;  ///< share of the bent knees that are bent forward, less that of the others; 0: none is bent

  bool are_exchanged() const { return toes + knees < -0.3; }
};
/// @param has_toes  the skeleton has joints for both feet
SidesDecision decide_sides(const PerFrame<Landmarks>& poses, bool has_toes);

/// Whether elbows or knees of a motion on our body bend backwards: rotations whose left and right are
/// exchanged, or those of a left-handed world, do that. The body itself has its left on the left.
bool bends_backwards(const motion::Clip& clip);

}  // namespace mimicx::import
