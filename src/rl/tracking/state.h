/// The state of the tracking task: exactly 570 numbers.                     docs/method.md §3
///
///     s_t = { P_{t+1} [186], β [10], P̂_t [186], P_{t+1} − P̂_t [186], root offset [2] }
///     P   = { r^h 1, r^a 6, ṙ^p 3, ṙ^a 3, x^a 17·6 + 4·1, ẋ^a 17·3 + 4·1, e^p 4·3 }
///
/// Both poses are expressed in the *simulated* character's heading frame (its yaw and place are removed), so
/// that the state does not depend on its heading and place in the world. Heights count from the ground under
/// the reference's pelvis, so that stairs look like a floor. The root offset is horizontal: the height is
/// already in P. Angular velocities of joints are in the child's frame.
///
/// The state of an option with an encoder is (docs/method.md §7)
///
///     s_t = { z, β [10], P̂_t [186], D(z) − P̂_t [186], root offset [2] },   z = E(P_{t+1})
///
/// with the reference's own heading frame for E and D: codes do not depend on the simulated character, and
/// only D(z) is turned into its frame.
#pragma once

#include <array>
#include <span>

#include "motion/reference.h"

namespace mimicx::rl::tracking {

inline constexpr int kPoseFeatures = 186;
inline constexpr int kJointFeatures = 106 + 55;  ///< x^a and ẋ^a: they do not depend on the heading
inline constexpr int kStateSize = 3 * kPoseFeatures + kBetas + 2;
static_assert(kStateSize == 570);

/// A pose with the world positions of its bodies, simulated or of a reference.
struct Pose {
  motion::ReferenceFrame frame;
  PerBody<Vector3d> p_WB;  ///< m
  double ground = 0.0;     ///< of a reference: height of the ground under its pelvis, m
};

/// Horizontal unit vector (cos, sin) of `heading_angle`, without computing the angle.
Eigen::Vector2d heading_direction(const Quaterniond& q_WB);

/// x^a (6D per spherical joint, angle per hinge) and ẋ^a (3 or 1), bodies in order.
std::array<float, kJointFeatures> joint_features(const motion::ReferenceFrame& frame);

/// Entries of an encoded state beside its code.
inline constexpr int kEncodedRest = kStateSize - kPoseFeatures;

/// P in the frame of heading (cos, sin). @param joints  the joint features, which are copied into it
/// @param ground  from where its height counts, m  @param out  [186]
void pose_features(const Pose& pose, const std::array<float, kJointFeatures>& joints,
                   const Eigen::Vector2d& heading, double ground, float* out);

/// P in the pose's own heading frame. @param out  [186]
void own_pose_features(const Pose& pose, float* out);

/// Turns pose features from the heading frame `from` into `to`, both (cos, sin). in and out [186]
void turn_features(const float* in, const Eigen::Vector2d& from, const Eigen::Vector2d& to, float* out);

/// s_t with an encoder. @param code  z  @param decoded  D(z), in the reference's own heading frame
/// @param out  [code size + kEncodedRest]
void encoded_state(std::span<const float> code, const std::array<float, kPoseFeatures>& decoded,
                   const Pose& reference, const std::array<double, kBetas>& betas, const Pose& simulated,
                   float* out);

/// s_t. @param out  [570]
void tracking_state(const Pose& reference, const std::array<float, kJointFeatures>& reference_joints,
                    const std::array<double, kBetas>& betas, const Pose& simulated, float* out);

}  // namespace mimicx::rl::tracking
