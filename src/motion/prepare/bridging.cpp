#include "motion/prepare/bridging.h"

#include "motion/prepare/glitches.h"
#include "motion/prepare/limb_glitches.h"

namespace mimicx::motion {

BridgedClip bridged(const Clip& clip) {
  BridgedClip out{clip, find_glitches(clip), 0};
  bridge_glitches(out.clip, out.flagged);
  const List<LimbGlitch> limbs = find_limb_glitches(out.clip);
  for (const LimbGlitch& glitch : limbs) out.limb_frames += glitch.last - glitch.first + 1;
  bridge_limb_glitches(out.clip, limbs);
  return out;
}

}  // namespace mimicx::motion
