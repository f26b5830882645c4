#include "import/evidence/angle_unit.h"

#include <algorithm>

#include "import/evidence/sides.h"

namespace mimicx::import {
namespace {

constexpr double kLeast = 0.8;     ///< no motion in radians stays below
constexpr double kMost = 20.0;     ///< some files count on over whole turns
constexpr double kHuman = 0.9;     ///< share of the frames
constexpr double kTravel = 0.5;    ///< lengths of the leg
constexpr double kPerFrame = 0.6;  ///< largest step of a joint that is no whirl, lengths of the leg
constexpr double kTrunkOverLegs =
    -0.3;  ///< cosine between trunk and the direction from the ankles to the hips

/// Share of the frames in which trunk and legs, and the way from the frame before, are a person's.
double human_share(const PerFrame<Landmarks>& poses) {
  const double leg = leg_length(poses);
  int human = 0;
  for (int t = 0; t < poses.count(); ++t) {
    const Landmarks& pose = poses[t];
    const Vector3d legs =
        (pose.between(kLeftHip, kRightHip) - pose.between(kLeftAnkle, kRightAnkle)).normalized();
    double step = 0.0;
    for (int b = 0; b < kBodies; ++b)
      step = std::max(step, t == 0 ? 0.0 : (pose.p[b] - poses[t - 1].p[b]).norm() / leg);
    human += legs.dot(pose.trunk()) > kTrunkOverLegs && step < kPerFrame;
  }
  return human / static_cast<double>(poses.size());
}

double travel_of(const PerFrame<Landmarks>& poses) {
  double most = 0.0;
  for (const Landmarks& pose : poses)
    most = std::max(most, (pose.between(kLeftHip, kRightHip) - poses[0].between(kLeftHip, kRightHip)).norm());
  return most / leg_length(poses);
}

double t_pose_share(const PerFrame<Landmarks>& poses) {
  return static_cast<double>(std::count_if(poses.begin(), poses.end(), is_t_pose)) /
         static_cast<double>(poses.size());
}

}  // namespace

bool may_be_radians(double largest) { return largest > kLeast && largest < kMost; }

AngleUnit decide_angle_unit(const PerFrame<Landmarks>& as_degrees, const PerFrame<Landmarks>& as_radians,
                            double largest) {
  if (!may_be_radians(largest)) return AngleUnit::kDegrees;
  const bool human = human_share(as_radians) > kHuman && !decide_sides(as_radians, false).are_exchanged();
  if (!human) return AngleUnit::kDegrees;
  const bool frozen = travel_of(as_degrees) > kTravel ||
                      (t_pose_share(as_degrees) > kHuman && t_pose_share(as_radians) < 0.5);
  return frozen ? AngleUnit::kRadians : AngleUnit::kUnsure;
}

}  // namespace mimicx::import
