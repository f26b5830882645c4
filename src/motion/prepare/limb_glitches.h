/// Glitches of one limb: for a few frames an estimator takes a leg or an arm for another one, or loses it
/// behind the body. The pose around it goes on, so find_glitches (glitches.h) sees nothing: it asks for jumps
/// that are fast for a whole body.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// Largest second difference of a limb's joints at frame t, 0 < t < frames − 1, m per frame². Joints of a leg
/// or an arm relative to the joint that it hangs on, those of the trunk as they are.
/// @param limb  as in kLimbOf
double limb_acceleration(const PerFrame<BodyPoses>& poses, int limb, int t);

/// Frames first … last of a limb (kLimbOf) that are somewhere else.
struct LimbGlitch {
  int limb = 0;
  int first = 0, last = 0;
};

/// A glitch is a stretch of at most a sixth of a second which a limb enters and leaves with accelerations
/// that no human reaches: 200 m/s² of one of its joints, relative to the joint that it hangs on. Without it,
/// bridged from the frame before to the frame after, the largest acceleration is at most a third. A stamp or
/// the end of a kick has one such moment, and no way back.
List<LimbGlitch> find_limb_glitches(const Clip& clip);

/// Turns the joints of the limb evenly from the frame before the glitch to the frame after it.
void bridge_limb_glitches(Clip& clip, const List<LimbGlitch>& glitches);

}  // namespace mimicx::motion
