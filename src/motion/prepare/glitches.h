/// Glitches of an estimator: finds frames in which the whole body is elsewhere and interpolates over them.
///
/// What it does not do: no glitches of single limbs (limb_glitches.h), no smoothing of the motion.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// Frames of an estimator's glitches. A glitch is a stretch of at most a third of a second between two jumps;
/// without it the motion is plausible. A jump is a step that no human makes: a joint moves at more than
/// 12 m/s or turns at more than 25 rad/s, three times faster than the motion around it. A glitch that touches
/// either end of the clip has one jump and lasts a sixth of a second at most.
PerFrame<bool> find_glitches(const Clip& clip);

/// Replaces the flagged frames by interpolation between their neighbours; at the ends by the nearest sound
/// frame. A clip without a sound frame stays as it is.
void bridge_glitches(Clip& clip, const PerFrame<bool>& flagged);

}  // namespace mimicx::motion
