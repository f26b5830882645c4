#include "pipeline/certainty.h"

#include <algorithm>
#include <cmath>

namespace mimicx::pipeline {
namespace {

/// Largest acceleration of each limb at frame t, in m/s² divided by the square of the frame rate.
Array<double, kLimbs> accelerations(const PerFrame<BodyPoses>& poses, int t) {
  Array<double, kLimbs> largest{};
  for (int body = 0; body < kBodies; ++body) {
    const int limb = kLimbOf[body], root = kLimbRoot[limb];
    const auto position = [&](int frame) -> Vector3d {
      const PerBody<Vector3d>& p = poses[frame].p_WB;
      return limb == 0 ? p[body] : Vector3d(p[body] - p[root]);
    };
    const double a = (position(t + 1) - 2.0 * position(t) + position(t - 1)).norm();
    largest[limb] = std::max(largest[limb], a);
  }
  return largest;
}

}  // namespace

List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible) {
  if (plausible == 0.0) return {};
  control::Certainty sure;
  sure.fill(1.0f);
  List<control::Certainty> certainty(reference.frames.size(), sure);
  for (int t = 1; t + 1 < reference.size(); ++t) {
    const Array<double, kLimbs> a = accelerations(reference.poses, t);
    for (int body = 0; body < kBodies; ++body) {
      const double excess = a[kLimbOf[body]] * reference.fps * reference.fps / plausible;
      const auto c = static_cast<float>(excess > 1.0 ? std::pow(excess, -4.0) : 1.0);
      for (int near : {t - 1, t, t + 1}) certainty[near][body] = std::min(certainty[near][body], c);
    }
  }
  for (int t = 0; t < reference.size(); ++t)
    if (reference.flagged[t])
      for (float& c : certainty[t]) c = std::min(c, kBridged);
  return certainty;
}

}  // namespace mimicx::pipeline
