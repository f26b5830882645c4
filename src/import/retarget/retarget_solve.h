/// The geometry of retargeting: how joints of a skeleton stand to bodies, and the pose that follows.
///
/// Every joint turns with a frame of its own, q_WJ; the body that it stands for has q_WB = q_WJ · q_JB with a
/// constant q_JB, found in neutral poses, where the orientation of the bodies is known from the positions of
/// the joints alone.
#pragma once

#include <array>
#include <vector>

#include "import/landmarks.h"

namespace mimicx::import {

/// Bones whose direction is kept: the body and the joint at its other end.
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
  PerBody<bool> turns{};             ///< has a joint that turns; else the body follows its parent
  Vector3d p_JS = Vector3d::Zero();  ///< middle of the shoulders in the chest joint's frame, m
};

/// Turns about thighs and upper arms, rad, that bring the hinges of knees and elbows into the planes in which
/// they bend. Index: kLeftHip, kRightHip, kLeftShoulder, kRightShoulder; others 0.
using Twists = PerBody<double>;

/// Finds how each body stands in the frame of its joint, as a mean over neutral poses. In a neutral pose a
/// body is taken to stand as if its bone had swung there from the T-pose by the shortest way; soles are
/// level.
/// @param neutral  poses that count as neutral, z up, m
/// @param turns    bodies that have a joint that turns
/// @param twists   of thighs and upper arms, on top of the shortest way
Calibration calibrate(const Character& character, const PerFrame<Landmarks>& neutral,
                      const PerBody<bool>& turns, const JointMap& map, const Twists& twists = {});

/// The twists, within ±90°, with which the hinges of knees and elbows explain best how the lower bones move.
/// Limbs that hardly bend show little of it and get twists near 0. Resolution: a tenth of a degree.
Twists measure_twists(const Character& character, const Calibration& calibration,
                      const PerFrame<Landmarks>& frames);

/// World rotations of the bodies for a pose: q_WJ · q_JB, then limbs and trunk swung onto their exact
/// directions.
PerBody<Quaterniond> body_rotations(const Character& character, const Calibration& calibration,
                                    const Landmarks& pose);

}  // namespace mimicx::import
