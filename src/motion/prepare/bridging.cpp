#include "motion/prepare/bridging.h"

#include <algorithm>
#include <cmath>

#include "motion/prepare/glitches.h"
#include "motion/prepare/limb_glitches.h"

namespace mimicx::motion {
namespace {

constexpr double kRate = 30.0;  ///< Hz, at about which glitches are searched

/// Every `step`-th frame of a clip.
Clip every(int step, int first, const Clip& clip) {
  Clip out = clip;
  out.fps = clip.fps / step;
  out.rotations.clear();
  out.trans.clear();
  for (int t = first; t < clip.frames(); t += step) {
    out.rotations.push_back(clip.rotations[t]);
    out.trans.push_back(clip.trans[t]);
  }
  return out;
}

}  // namespace

BridgedClip bridged(const Clip& clip) {
  BridgedClip out{clip, PerFrame<bool>(clip.frames(), false), 0};
  const int step = std::max(1, static_cast<int>(std::lround(clip.fps / kRate)));
  for (int first = 0; first < step; ++first) {
    Clip part = every(step, first, clip);
    const PerFrame<bool> flagged = find_glitches(part);
    bridge_glitches(part, flagged);
    const List<LimbGlitch> limbs = find_limb_glitches(part);
    for (const LimbGlitch& glitch : limbs) out.limb_frames += glitch.last - glitch.first + 1;
    bridge_limb_glitches(part, limbs);
    for (int k = 0; k < part.frames(); ++k) {
      const int t = first + k * step;
      out.flagged[t] = flagged[k];
      out.clip.rotations[t] = part.rotations[k];
      out.clip.trans[t] = part.trans[k];
    }
  }
  return out;
}

}  // namespace mimicx::motion
