/// A motion without its glitches: those of whole poses (glitches.h) and of single limbs (limb_glitches.h).
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

struct BridgedClip {
  Clip clip;               ///< interpolated over them
  PerFrame<bool> flagged;  ///< [frames] whole poses that were interpolated
  int limb_frames = 0;     ///< frames of single limbs
};

BridgedClip bridged(const Clip& clip);

}  // namespace mimicx::motion
