/// The geometry of retargeting: constant rotations between a skeleton's joints and the bodies, and the
/// bodies' poses from them.
///
/// A joint has a world rotation q_WJ; its body has q_WB = q_WJ · q_JB with a constant q_JB. q_JB is found in
/// neutral poses, where the positions of the joints determine the orientations of the bodies.
#pragma once

#include <array>
#include <vector>

#include "import/landmarks.h"

namespace mimicx::import {

/// A bone whose direction is kept: its body and the joint at its other end.
struct Bone {
  int body, end;
};
inline constexpr std::array<Bone, 8> kBones = {{{kLeftHip, kLeftKnee},
                                                {kRightHip, kRightKnee},
                                                {kLeftKnee, kLeftAnkle},
                                                {kRightKnee, kRightAnkle},
                                                {kLeftShoulder, kLeftElbow},
                                                {kRightShoulder, kRightElbow},
                                                {kLeftElbow, kLeftWrist},
                                                {kRightElbow, kRightWrist}}};

struct Calibration {
  PerBody<Quaterniond> q_JB;         ///< body in the frame of its joint
  PerBody<bool> turns{};             ///< the body has a joint with rotations; else it follows its parent
  Vector3d p_JS = Vector3d::Zero();  ///< middle of the shoulders in the chest joint's frame, m
};

/// Rotations about the axes of thighs and upper arms, rad, that align the hinges of knees and elbows with the
/// planes in which they bend. Index: kLeftHip, kRightHip, kLeftShoulder, kRightShoulder; others 0.
using Twists = PerBody<double>;

/// Poses for the calibration, z up, m.
struct NeutralPoses {
  PerFrame<Landmarks> body;
  PerFrame<Landmarks> left_foot, right_foot;  ///< the sole of this foot is level; empty: those of `body`
};

/// The rotation of each body in the frame of its joint, as a mean over neutral poses. In a neutral pose a
/// body is assumed to be turned from the T-pose by the smallest rotation that gives its bone's direction, and
/// soles are assumed to be level.
/// @param turns    bodies whose joint has rotations
/// @param twists   of thighs and upper arms, in addition to the smallest rotation
Calibration calibrate(const Character& character, const NeutralPoses& neutral, const PerBody<bool>& turns,
                      const JointMap& map, const Twists& twists = {});

/// Middle of the shoulders in the chest joint's frame, mean over the poses, m.
Vector3d shoulders_in_chest(const PerFrame<Landmarks>& poses);

/// The twists, within ±90°, for which the hinges of knees and elbows fit the motion of the lower bones best.
/// Limbs that hardly bend get twists near 0. Resolution: a tenth of a degree.
Twists measure_twists(const Character& character, const Calibration& calibration,
                      const PerFrame<Landmarks>& frames);

/// World rotations of the bodies for a pose: q_WJ · q_JB, then corrected so that limbs and trunk have their
/// exact directions.
PerBody<Quaterniond> body_rotations(const Character& character, const Calibration& calibration,
                                    const Landmarks& pose);

}  // namespace mimicx::import
