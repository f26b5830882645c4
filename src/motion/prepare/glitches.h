/// Glitches of an estimator: finds frames in which the body jumps away and back, and interpolates over them.
///
/// What it does not do: no glitches of single limbs (limb_glitches.h), no smoothing of the motion.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// Flags the frames of glitches. A glitch lasts at most a third of a second between two jumps, and the motion
/// is plausible without it. A jump is a step that no human makes: a joint moves at more than 12 m/s, the
/// pelvis at more than 5 m/s, or a joint turns at more than 25 rad/s, three times faster than in the
/// neighbouring frames. A glitch at the start or end of the clip has one jump and lasts at most a sixth of a
/// second.
PerFrame<bool> find_glitches(const Clip& clip);

/// Interpolates the flagged frames between their neighbours; at the ends of the clip they become the nearest
/// frame that is not flagged. A clip with all frames flagged stays unchanged.
void bridge_glitches(Clip& clip, const PerFrame<bool>& flagged);

}  // namespace mimicx::motion
