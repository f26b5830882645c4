#include "rl/tracking/state.h"

#include <algorithm>

#include "core/elementary.h"

namespace mimicx::rl::tracking {
namespace {

/// Writes v in the heading frame.
float* put(const Vector3d& v, const Eigen::Vector2d& heading, float* out) {
  out[0] = static_cast<float>(heading.x() * v.x() + heading.y() * v.y());
  out[1] = static_cast<float>(heading.x() * v.y() - heading.y() * v.x());
  out[2] = static_cast<float>(v.z());
  return out + 3;
}

void put_root_offset(const Pose& reference, const Pose& simulated, const Eigen::Vector2d& heading,
                     float* out) {
  float planar[3];
  put(reference.frame.p_root - simulated.frame.p_root, heading, planar);
  out[0] = planar[0];
  out[1] = planar[1];
}

}  // namespace

Eigen::Vector2d heading_direction(const Quaterniond& q_WB) {
  Vector3d forward = q_WB * Vector3d::UnitZ();
  if (hypot(forward.x(), forward.y()) < 1e-3) forward = q_WB * Vector3d::UnitY();
  return forward.head<2>().normalized();
}

std::array<float, kJointFeatures> joint_features(const motion::ReferenceFrame& frame) {
  std::array<float, kJointFeatures> features{};
  float* rotation = features.data();
  float* velocity = features.data() + 106;
  for (int body = 1; body < kBodies; ++body) {
    if (is_hinge(body)) {
      const Vector3d axis = hinge_axis(body);
      *rotation++ = static_cast<float>(log_map(frame.q[body]).dot(axis));
      *velocity++ = static_cast<float>(frame.omega[body].dot(axis));
    } else {
      const Vector6d r = rotation_6d(frame.q[body]);
      for (int k = 0; k < 6; ++k) *rotation++ = static_cast<float>(r[k]);
      for (int k = 0; k < 3; ++k) *velocity++ = static_cast<float>(frame.omega[body][k]);
    }
  }
  return features;
}

void pose_features(const Pose& pose, const std::array<float, kJointFeatures>& joints,
                   const Eigen::Vector2d& heading, double ground, float* out) {
  const motion::ReferenceFrame& f = pose.frame;
  *out++ = static_cast<float>(f.p_root.z() - ground);
  const Vector6d root = rotation_6d(f.q[0]);
  out = put(root.head<3>(), heading, out);
  out = put(root.tail<3>(), heading, out);
  out = put(f.v_root, heading, out);
  out = put(f.q[0] * f.omega[0], heading, out);
  for (float x : joints) *out++ = x;
  for (int body : kEndEffectors) out = put(pose.p_WB[body] - f.p_root, heading, out);
}

void own_pose_features(const Pose& pose, float* out) {
  pose_features(pose, joint_features(pose.frame), heading_direction(pose.frame.q[0]), pose.ground, out);
}

void turn_features(const float* in, const Eigen::Vector2d& from, const Eigen::Vector2d& to, float* out) {
  // Angle between the frames: from `from` into the world, then into `to`.
  const Eigen::Vector2d turn = {to.dot(from), to.y() * from.x() - to.x() * from.y()};
  const auto put_turned = [&](int first, int vectors) {
    for (int k = first; k < first + 3 * vectors; k += 3)
      put(Eigen::Vector3f(in[k], in[k + 1], in[k + 2]).cast<double>(), turn, out + k);
  };
  constexpr int kRootVectors = 4;  // two of r^a, ṙ^p, ṙ^a
  out[0] = in[0];
  put_turned(1, kRootVectors);
  constexpr int kFirstJoint = 1 + 3 * kRootVectors, kFirstEffector = kFirstJoint + kJointFeatures;
  std::copy(in + kFirstJoint, in + kFirstEffector, out + kFirstJoint);
  put_turned(kFirstEffector, static_cast<int>(kEndEffectors.size()));
}

void encoded_state(std::span<const float> code, const std::array<float, kPoseFeatures>& decoded,
                   const Pose& reference, const std::array<double, kBetas>& betas, const Pose& simulated,
                   float* out) {
  const Eigen::Vector2d heading = heading_direction(simulated.frame.q[0]);
  float* shape = std::copy(code.begin(), code.end(), out);
  float* of_simulated = shape + kBetas;
  float* difference = of_simulated + kPoseFeatures;
  float* offset = difference + kPoseFeatures;
  for (std::size_t k = 0; k < kBetas; ++k) shape[k] = static_cast<float>(betas[k]);
  pose_features(simulated, joint_features(simulated.frame), heading, reference.ground, of_simulated);
  turn_features(decoded.data(), heading_direction(reference.frame.q[0]), heading, difference);
  for (int k = 0; k < kPoseFeatures; ++k) difference[k] -= of_simulated[k];
  put_root_offset(reference, simulated, heading, offset);
}

void tracking_state(const Pose& reference, const std::array<float, kJointFeatures>& reference_joints,
                    const std::array<double, kBetas>& betas, const Pose& simulated, float* out) {
  const Eigen::Vector2d heading = heading_direction(simulated.frame.q[0]);
  float* of_reference = out;
  float* shape = of_reference + kPoseFeatures;
  float* of_simulated = shape + kBetas;
  float* difference = of_simulated + kPoseFeatures;
  float* offset = difference + kPoseFeatures;
  pose_features(reference, reference_joints, heading, reference.ground, of_reference);
  for (std::size_t k = 0; k < kBetas; ++k) shape[k] = static_cast<float>(betas[k]);
  pose_features(simulated, joint_features(simulated.frame), heading, reference.ground, of_simulated);
  for (int k = 0; k < kPoseFeatures; ++k) difference[k] = of_reference[k] - of_simulated[k];
  put_root_offset(reference, simulated, heading, offset);
}

}  // namespace mimicx::rl::tracking
