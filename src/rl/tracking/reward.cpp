#include "rl/tracking/reward.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mimicx::rl {
namespace {

double squared_angle(const Quaterniond& a, const Quaterniond& b) {
  return log_map(a.conjugate() * b).squaredNorm();
}

/// Confidence-weighted mean squared pixel error in units of the box height.
double projection_error(const KeypointFrame& keypoints, const PerBody<Vector3d>& p_WB) {
  double sum = 0.0, weights = 0.0;
  for (const auto& d : keypoints.detections) {
    const Vector3d image = keypoints.projection * p_WB[static_cast<std::size_t>(d.body)].homogeneous();
    if (image.z() < 1e-3) continue;  // behind the camera: no pixel to compare with
    const double du = image.x() / image.z() - d.u, dv = image.y() / image.z() - d.v;
    sum += d.weight * (du * du + dv * dv);
    weights += d.weight;
  }
  return weights > 0.0 ? sum / (weights * keypoints.box_height * keypoints.box_height) : 0.0;
}

}  // namespace

std::vector<KeypointFrame> match_keypoints(const Keypoints& keypoints) {
  std::vector<KeypointFrame> frames(keypoints.uvc.size());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    KeypointFrame& frame = frames[t];
    const Eigen::Matrix4d& extrinsics = keypoints.extrinsics[std::min(t, keypoints.extrinsics.size() - 1)];
    frame.projection = keypoints.intrinsics * extrinsics.topRows<3>();
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    for (std::size_t k = 0; k < keypoints.names.size(); ++k) {
      const Vector3d& uvc = keypoints.uvc[t][k];
      const int body = body_of_name(keypoints.names[k]);
      if (!(uvc.z() > 0.0) || body < 0) continue;
      frame.detections.push_back({body, uvc.x(), uvc.y(), uvc.z()});
      top = std::min(top, uvc.y());
      bottom = std::max(bottom, uvc.y());
    }
    frame.box_height = bottom - top;
    if (!(frame.box_height > 1.0)) frame.detections.clear();  // one point, or a person of no height
  }
  return frames;
}

Reward tracking_reward(const RewardWeights& weights, const Pose& reference, const Pose& simulated,
                       const KeypointFrame* keypoints) {
  const ReferenceFrame &r = reference.frame, &s = simulated.frame;
  double pose = 0.0, velocity = 0.0, end_effector = 0.0;
  for (std::size_t i = 1; i < kBodies; ++i) {
    pose += squared_angle(s.q[i], r.q[i]);
    velocity += (s.omega[i] - r.omega[i]).squaredNorm();
  }
  for (int body : kEndEffectors) {
    const auto i = static_cast<std::size_t>(body);
    end_effector += ((simulated.p_WB[i] - s.p_root) - (reference.p_WB[i] - r.p_root)).squaredNorm();
  }
  const bool seen = keypoints != nullptr && !keypoints->detections.empty();
  Reward reward;
  reward.term = {std::exp(-weights.root_position * (s.p_root - r.p_root).squaredNorm()),
                 std::exp(-weights.root_rotation * squared_angle(s.q[0], r.q[0])),
                 std::exp(-weights.pose * pose / kJoints),
                 std::exp(-weights.velocity * velocity / kJoints),
                 std::exp(-weights.end_effector * end_effector / static_cast<double>(kEndEffectors.size())),
                 seen ? std::exp(-weights.projection * projection_error(*keypoints, simulated.p_WB)) : 1.0};
  reward.total = 1.0;
  for (double term : reward.term) reward.total *= term;
  return reward;
}

}  // namespace mimicx::rl
