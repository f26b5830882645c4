#include "plan/certainty.h"

#include <algorithm>

#include "core/elementary.h"
#include "motion/prepare/limb_glitches.h"

namespace mimicx::plan {
List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible) {
  if (plausible == 0.0) return {};
  control::Certainty sure;
  sure.fill(1.0f);
  List<control::Certainty> certainty(reference.frames.size(), sure);
  for (int t = 1; t + 1 < reference.size(); ++t) {
    Array<double, kLimbs> a;
    for (int limb = 0; limb < kLimbs; ++limb) a[limb] = motion::limb_acceleration(reference.poses, limb, t);
    for (int body = 0; body < kBodies; ++body) {
      const double excess = a[kLimbOf[body]] * reference.fps * reference.fps / plausible;
      const auto c = static_cast<float>(excess > 1.0 ? pow(excess, -4) : 1.0);
      for (int near : {t - 1, t, t + 1}) certainty[near][body] = std::min(certainty[near][body], c);
    }
  }
  for (int t = 0; t < reference.size(); ++t)
    if (reference.flagged[t])
      for (float& c : certainty[t]) c = std::min(c, kBridged);
  return certainty;
}

}  // namespace mimicx::plan
