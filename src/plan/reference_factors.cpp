#include "plan/reference_factors.h"

#include <algorithm>

#include "core/elementary.h"
#include "motion/prepare/limb_glitches.h"

namespace mimicx::plan {
namespace {

constexpr double kNeedReach = 0.1;  // s
}  // namespace

List<control::Certainty> certainty_of(const motion::Reference& reference, double plausible) {
  control::Certainty sure;
  sure.fill(1.0f);
  List<control::Certainty> certainty(reference.frames.size(), sure);
  if (plausible == 0.0) return certainty;
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

List<float> momentum_factors(const audit::PoseNeeds& needs, int frames, double tolerated) {
  List<float> factors(frames, 1.0f);
  const int reach = static_cast<int>(kNeedReach * needs.fps);
  for (int t = 0; t < needs.frames.count(); ++t) {
    const double excess = needs.frames[t].force.norm() / (tolerated * needs.weight);
    const auto m = static_cast<float>(pow(1.0 + excess * excess, -2));
    for (int near = std::max(t - reach, 0); near <= std::min(t + reach, frames - 1); ++near)
      factors[near] = std::min(factors[near], m);
  }
  return factors;
}

List<control::FrameFactors> factors_of(const motion::Reference& reference, const audit::PoseNeeds& needs,
                                       const MotionPlanConfig& config) {
  const auto certainty = certainty_of(reference, config.plausible_acceleration);
  const auto momentum = momentum_factors(needs, reference.size(), config.feasible_need);
  List<control::FrameFactors> factors(reference.size());
  for (int t = 0; t < reference.size(); ++t) {
    factors[t].certainty = certainty[t];
    factors[t].momentum = momentum[t];
  }
  return factors;
}

}  // namespace mimicx::plan
