#include "import/evidence/sides.h"

#include <array>

namespace mimicx::import {
namespace {

constexpr double kBentCosine = 0.9;  ///< cosine between thigh and shank: 26°

}  // namespace

SidesDecision decide_sides(const PerFrame<Landmarks>& poses, bool has_toes) {
  SidesDecision out;
  int bent = 0;
  for (const Landmarks& pose : poses)
    for (const auto& [hip, knee, ankle, toes] :
         {std::array{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
          std::array{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}) {
      const Vector3d forward = pose.forward();
      if (has_toes)
        out.toes += pose.direction(ankle, toes).dot(forward) / (2.0 * static_cast<double>(poses.size()));
      if (pose.direction(hip, knee).dot(pose.direction(knee, ankle)) > kBentCosine) continue;
      ++bent;
      const Vector3d middle = 0.5 * (pose.p[hip] + pose.p[ankle]);
      out.knees += (pose.p[knee] - middle).dot(forward) > 0.0 ? 1.0 : -1.0;
    }
  if (bent > 0) out.knees /= bent;
  return out;
}

}  // namespace mimicx::import
