/// A motion without its glitches: those of whole poses (glitches.h) and of single limbs (limb_glitches.h).
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

struct BridgedClip {
  Clip clip;               ///< interpolated over them
  PerFrame<bool> flagged;  ///< [frames] whole poses that were interpolated
  int limb_frames = 0;     ///< frames of single limbs
};

/// A clip of a higher rate is searched in interleaved parts of about 30 frames per second: the faster the
/// frames follow each other, the more do errors of a place count as speed.
BridgedClip bridged(const Clip& clip);

}  // namespace mimicx::motion
