/// A synthetic wave whose right hand is led through the head, as estimates do, and a camera that sees a
/// motion.
#pragma once

#include <algorithm>

#include "motion/keypoint_names.h"
#include "motion/synthetic_clip.h"

namespace mimicx::test {

/// Middle of the right hand's capsule, and the right elbow, in the head's frame, m.
struct ArmPlaces {
  Vector3d hand, elbow;
};
inline ArmPlaces arm_places(const Character& character, const BodyPoses& poses) {
  const Capsule& hand = character.capsule[kRightWrist];
  const Vector3d middle =
      poses.p_WB[kRightWrist] + poses.q_WB[kRightWrist] * Vector3d(0.5 * (hand.a_B + hand.b_B));
  const Quaterniond to_head = poses.q_WB[kHead].conjugate();
  return {to_head * (middle - poses.p_WB[kHead]), to_head * (poses.p_WB[kRightElbow] - poses.p_WB[kHead])};
}

/// Turns shoulder and elbow of the right arm so that the hand is at a place of the head's frame; the elbow is
/// drawn to its own place more weakly.
inline void reach(const Character& character, const ArmPlaces& places, PerBody<Quaterniond>& q) {
  constexpr double kDelta = 1e-6, kElbowWeight = 0.3;
  using Residual = Eigen::Matrix<double, 6, 1>;
  const auto turned = [&](const Eigen::Vector4d& c) {
    PerBody<Quaterniond> out = q;
    out[kRightShoulder] = (q[kRightShoulder] * exp_map(Vector3d(c.head<3>()))).normalized();
    out[kRightElbow] = (q[kRightElbow] * exp_map(c[3] * hinge_axis(kRightElbow))).normalized();
    return out;
  };
  const auto error = [&](const Eigen::Vector4d& c) {
    const ArmPlaces now = arm_places(character, forward_kinematics(character, Vector3d::Zero(), turned(c)));
    Residual r;
    r << now.hand - places.hand, kElbowWeight * (now.elbow - places.elbow);
    return r;
  };
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Residual now = error(Eigen::Vector4d::Zero());
    Eigen::Matrix<double, 6, 4> J;
    for (int k = 0; k < 4; ++k) J.col(k) = (error(kDelta * Eigen::Vector4d::Unit(k)) - now) / kDelta;
    const Eigen::Matrix4d A = J.transpose() * J + 1e-5 * Eigen::Matrix4d::Identity();
    const Eigen::Vector4d step = -A.inverse() * J.transpose() * now;
    q = turned(std::min(1.0, 0.2 / std::max(step.norm(), 1e-12)) * step);
    if (step.norm() < 1e-6) break;
  }
}

/// The hand is at the face until the first of these frames, and behind the head from the second one on.
inline constexpr int kPassageFrom = 40, kPassageTo = kPassageFrom + 10;

/// Three seconds. The right hand of a wave comes to the face, goes through the head, and stays behind it.
/// @param aside  m, by which it goes around the head, on the right
inline motion::Clip clip_with_passing_hand(double aside = 0.0) {
  motion::Clip clip = synthetic_clip("wave", 501, 90);
  const Character character = make_character(clip.usable_betas());
  const PerFrame<PerBody<Quaterniond>> waved = motion::joint_rotations(clip);
  const auto smooth = [](double s) {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
  };
  const Vector3d rest(-0.35, -0.3, 0.3), front(0.0, 0.07, 0.16), back(0.0, 0.07, -0.16);
  PerBody<Quaterniond> before = waved[0];
  for (int t = 0; t < clip.frames(); ++t) {
    Vector3d place = rest + smooth(t / 35.0) * (front - rest);
    const double through = std::clamp((t - kPassageFrom) / 10.0, 0.0, 1.0);
    place += through * (back - front) - 4.0 * through * (1.0 - through) * aside * Vector3d::UnitX();
    PerBody<Quaterniond> q = waved[t];
    for (int body : {kRightShoulder, kRightElbow}) q[body] = before[body];
    reach(character, {place, Vector3d(-0.28, 0.0, 0.0)}, q);
    before = q;
    for (int body : {kRightShoulder, kRightElbow}) clip.rotations[t][body] = log_map(q[body]);
  }
  return clip;
}

/// A camera that looks along a direction of the world at the head, from 4 m away, and what it sees of the
/// joints of a motion.
inline motion::Keypoints seen_along(const PerFrame<BodyPoses>& all, const Vector3d& direction) {
  motion::Keypoints keypoints;
  keypoints.names = motion::keypoint_names(motion::KeypointSet::kJoints22);
  keypoints.intrinsics << 1000, 0, 500, 0, 1000, 500, 0, 0, 1;
  const Vector3d forward = direction.normalized(), down = -Vector3d::UnitZ();
  Matrix3d R;
  R << down.cross(forward).transpose(), down.transpose(), forward.transpose();
  Eigen::Matrix4d E = Eigen::Matrix4d::Identity();
  E.topLeftCorner<3, 3>() = R;
  E.topRightCorner<3, 1>() = -R * (all[0].p_WB[kHead] - 4.0 * forward);
  keypoints.extrinsics = {E};
  for (const BodyPoses& poses : all) {
    keypoints.uvc.emplace_back();
    for (const Vector3d& p : poses.p_WB) {
      const Vector3d pixel = keypoints.intrinsics * (E * p.homogeneous()).head<3>();
      keypoints.uvc.back().push_back({pixel.x() / pixel.z(), pixel.y() / pixel.z(), 1.0});
    }
  }
  return keypoints;
}

}  // namespace mimicx::test
