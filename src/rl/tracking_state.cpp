#include "rl/tracking_state.h"

#include <cmath>

namespace mimicx::rl {
namespace {

/// Writes v turned back by the heading.
float* put(const Vector3d& v, const Eigen::Vector2d& heading, float* out) {
  out[0] = static_cast<float>(heading.x() * v.x() + heading.y() * v.y());
  out[1] = static_cast<float>(heading.x() * v.y() - heading.y() * v.x());
  out[2] = static_cast<float>(v.z());
  return out + 3;
}

}  // namespace

Eigen::Vector2d heading_direction(const Quaterniond& q_WB) {
  Vector3d forward = q_WB * Vector3d::UnitZ();
  if (std::hypot(forward.x(), forward.y()) < 1e-3) forward = q_WB * Vector3d::UnitY();
  return forward.head<2>().normalized();
}

std::array<float, kJointFeatures> joint_features(const ReferenceFrame& frame) {
  std::array<float, kJointFeatures> features{};
  float* rotation = features.data();
  float* velocity = features.data() + 106;
  for (int body = 1; body < kBodies; ++body) {
    const auto i = static_cast<std::size_t>(body);
    if (is_hinge(body)) {
      const Vector3d axis = hinge_axis(body);
      *rotation++ = static_cast<float>(log_map(frame.q[i]).dot(axis));
      *velocity++ = static_cast<float>(frame.omega[i].dot(axis));
    } else {
      const Vector6d r = rotation_6d(frame.q[i]);
      for (int k = 0; k < 6; ++k) *rotation++ = static_cast<float>(r[k]);
      for (int k = 0; k < 3; ++k) *velocity++ = static_cast<float>(frame.omega[i][k]);
    }
  }
  return features;
}

void pose_features(const Pose& pose, const std::array<float, kJointFeatures>& joints,
                   const Eigen::Vector2d& heading, float* out) {
  const ReferenceFrame& f = pose.frame;
  *out++ = static_cast<float>(f.p_root.z());
  const Vector6d root = rotation_6d(f.q[0]);
  out = put(root.head<3>(), heading, out);
  out = put(root.tail<3>(), heading, out);
  out = put(f.v_root, heading, out);
  out = put(f.q[0] * f.omega[0], heading, out);
  for (float x : joints) *out++ = x;
  for (int body : kEndEffectors)
    out = put(pose.p_WB[static_cast<std::size_t>(body)] - f.p_root, heading, out);
}

void tracking_state(const Pose& reference, const std::array<float, kJointFeatures>& reference_joints,
                    const std::array<double, kBetas>& betas, const Pose& simulated, float* out) {
  const Eigen::Vector2d heading = heading_direction(simulated.frame.q[0]);
  float* P = out;
  float* beta = P + kPoseFeatures;
  float* P_hat = beta + kBetas;
  float* difference = P_hat + kPoseFeatures;
  float* offset = difference + kPoseFeatures;
  pose_features(reference, reference_joints, heading, P);
  for (std::size_t k = 0; k < kBetas; ++k) beta[k] = static_cast<float>(betas[k]);
  pose_features(simulated, joint_features(simulated.frame), heading, P_hat);
  for (int k = 0; k < kPoseFeatures; ++k) difference[k] = P[k] - P_hat[k];
  float planar[3];
  put(reference.frame.p_root - simulated.frame.p_root, heading, planar);
  offset[0] = planar[0];
  offset[1] = planar[1];
}

}  // namespace mimicx::rl
