#include "import/evidence/sides.h"

#include <array>

#include "character/character.h"

namespace mimicx::import {
namespace {

constexpr double kBentCosine = 0.9;  ///< cosine between thigh and shank: 26°
constexpr int kFewBent = 20;         ///< poses of a joint that may be errors

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

bool bends_backwards(const motion::Clip& clip) {
  const PerBody<Vector3d> rest = joint_offsets({});
  const auto is_wrong = [&](const std::array<int, 2>& hinges, double forward) {
    double sum = 0.0, size = 0.0;
    int bent = 0;
    for (const auto& rotations : clip.rotations)
      for (const int hinge : hinges) {
        const Vector3d bone =
            rest[hinge + 2].normalized();  // to the wrist or ankle; at rest the body faces z
        const Vector3d now = exp_map(rotations[hinge]) * bone;
        if (now.dot(bone) > kBentCosine) continue;
        ++bent;
        sum += forward * now.z();
        size += (now - now.dot(bone) * bone).norm();
      }
    return bent > kFewBent && sum < -0.5 * size;
  };
  return is_wrong({kLeftElbow, kRightElbow}, 1.0) || is_wrong({kLeftKnee, kRightKnee}, -1.0);
}

}  // namespace mimicx::import
