/// Glitches of one limb: for a few frames an estimator confuses a leg or an arm with another one, or loses it
/// behind the body. The rest of the pose is right, so find_glitches (glitches.h), whose limits are those of a
/// whole body, does not find them.
#pragma once

#include "motion/clip.h"

namespace mimicx::motion {

/// Largest second difference of a limb's joints at frame t, 0 < t < frames − 1, m per frame². Joints of a leg
/// or an arm are taken relative to the hip or shoulder, joints of the trunk in the world.
/// @param limb  as in kLimbOf
double limb_acceleration(const PerFrame<BodyPoses>& poses, int limb, int t);

/// Frames first … last in which a limb (kLimbOf) is displaced.
struct LimbGlitch {
  int limb = 0;
  int first = 0, last = 0;
};

/// A glitch lasts at most a sixth of a second. The limb enters and leaves it with accelerations that no human
/// reaches: 200 m/s² of one of its joints, as `limb_acceleration` measures it. Interpolated from the frame
/// before to the frame after, the largest acceleration is at most a third. A stamp or the end of a kick has
/// one such acceleration only, so it is no glitch.
List<LimbGlitch> find_limb_glitches(const Clip& clip);

/// Interpolates the rotations of the limb's joints from the frame before the glitch to the frame after it.
void bridge_limb_glitches(Clip& clip, const List<LimbGlitch>& glitches);

}  // namespace mimicx::motion
