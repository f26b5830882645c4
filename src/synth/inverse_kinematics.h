/// Inverse kinematics of the legs of synthetic motions: the joint rotations that put a foot on its target.
///
/// Closed form: the knee angle from the distance hip–ankle, the hip from that direction and the plane the
/// knee bends in, the ankle from the foot's orientation. No iteration, hence smooth in its arguments.
/// What it does not do: no joint limits. For a target out of reach the leg is stretched, and the shortfall is
/// reported.
#pragma once

#include "character/character.h"

namespace mimicx::synth {

/// Model axes (x left, y up, z forward) → plan axes (x forward, y left, z up): a cyclic permutation.
inline const Quaterniond kModelToPlan{0.5, 0.5, 0.5, 0.5};

/// A foot on or over the floor. It rolls about its two heel points (toe_rise) or its two toe points
/// (heel_rise), which keep their places.
struct FootTarget {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< floor point under the ankle of the flat foot, m
  double yaw = 0.0;                                 ///< about the vertical, 0 = toes along x, rad
  double lift = 0.0;                                ///< height of the sole, m
  double heel_rise = 0.0;                           ///< pitch of the foot over its toes, rad, ≥ 0
  double toe_rise = 0.0;                            ///< pitch of the foot over its heel, rad, ≥ 0
};

/// World pose of the ankle's body and rotation of the toes relative to it.
struct FootPose {
  Vector3d p_ankle;
  Quaterniond q_ankle;
  Quaterniond q_toes;
};

/// @param side  0 left, 1 right
FootPose foot_pose(const Character& character, int side, const FootTarget& target);

struct LegPose {
  Quaterniond hip;    ///< relative to the pelvis
  double knee;        ///< flexion, rad
  Quaterniond ankle;  ///< relative to the shank
  double shortfall;   ///< distance of the ankle from its target, m; 0 within reach
};

/// @param knee_axis  world direction of the knee's axis (to the character's left)
LegPose solve_leg(const Character& character, int side, const Vector3d& p_pelvis, const Quaterniond& q_pelvis,
                  const FootPose& foot, const Vector3d& knee_axis);

}  // namespace mimicx::synth
