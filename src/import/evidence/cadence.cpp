#include "import/evidence/cadence.h"

#include <cmath>
#include <vector>

#include "core/quantile.h"
#include "core/units.h"

namespace mimicx::import {
namespace {

constexpr double kUsualCadence = 0.52;  ///< f √(L/g)
constexpr std::size_t kFewestSteps = 4;
// Lengths in lengths of the leg.
constexpr double kApart = 0.15;                            ///< one foot in front of the other
constexpr double kShortestStep = 0.5, kLongestStep = 1.1;  ///< of the pelvis, in a walk

/// The frames in which the other foot passes to the front.
std::vector<int> steps_of(const PerFrame<Landmarks>& poses, const Vector3d& up) {
  const double apart = kApart * leg_length(poses);
  std::vector<int> steps;
  double front = 0.0;  // 1: the left foot
  for (int t = 0; t < poses.count(); ++t) {
    const Vector3d forward = (poses[t].p[kLeftHip] - poses[t].p[kRightHip]).cross(up).normalized();
    const double ahead = (poses[t].p[kLeftAnkle] - poses[t].p[kRightAnkle]).dot(forward);
    if (std::abs(ahead) < apart || std::copysign(1.0, ahead) == front) continue;
    if (front != 0.0) steps.push_back(t);
    front = std::copysign(1.0, ahead);
  }
  return steps;
}

}  // namespace

std::optional<double> walking_leg(const PerFrame<Landmarks>& poses, const Vector3d& up, double fps) {
  const std::vector<int> steps = steps_of(poses, up);
  if (steps.size() <= kFewestSteps) return {};
  const double leg = leg_length(poses);
  std::vector<double> frames, lengths;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Vector3d way = poses[steps[i]].p[kPelvis] - poses[steps[i - 1]].p[kPelvis];
    frames.push_back(steps[i] - steps[i - 1]);
    lengths.push_back((way - way.dot(up) * up).norm() / leg);
  }
  const double length = median(lengths), cadence = fps / median(frames);
  if (length < kShortestStep || length > kLongestStep) return {};
  return kGravity * (kUsualCadence / cadence) * (kUsualCadence / cadence);
}

}  // namespace mimicx::import
