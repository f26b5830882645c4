#include "rl/tracking/reward.h"

#include "core/elementary.h"

namespace mimicx::rl::tracking {
namespace {

double squared_angle(const Quaterniond& a, const Quaterniond& b) {
  return log_map(a.conjugate() * b).squaredNorm();
}

/// Position of a body in the frame of the root, m.
Vector3d from_root(const Pose& pose, int body) {
  return pose.frame.q[0].conjugate() * Vector3d(pose.p_WB[body] - pose.frame.p_root);
}

}  // namespace

Reward tracking_reward(const RewardWeights& weights, const Pose& reference, const Pose& simulated,
                       const KeypointFrame* keypoints) {
  const motion::ReferenceFrame &r = reference.frame, &s = simulated.frame;
  double pose = 0.0, velocity = 0.0, end_effector = 0.0;
  for (int i = 1; i < kBodies; ++i) {
    pose += squared_angle(s.q[i], r.q[i]);
    velocity += (s.omega[i] - r.omega[i]).squaredNorm();
  }
  for (const int i : kEndEffectors) {
    end_effector += (from_root(simulated, i) - from_root(reference, i)).squaredNorm();
  }
  const bool seen = keypoints != nullptr && !keypoints->detections.empty();
  Reward reward;
  reward.term = {exp(-weights.root_position * (s.p_root - r.p_root).squaredNorm()),
                 exp(-weights.root_rotation * squared_angle(s.q[0], r.q[0])),
                 exp(-weights.pose * pose / kJoints),
                 exp(-weights.velocity * velocity / kJoints),
                 exp(-weights.end_effector * end_effector / static_cast<double>(kEndEffectors.size())),
                 seen ? exp(-weights.projection * projection_error(*keypoints, simulated.p_WB)) : 1.0};
  reward.total = 1.0;
  for (double term : reward.term) reward.total *= term;
  return reward;
}

}  // namespace mimicx::rl::tracking
