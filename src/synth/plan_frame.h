/// A frame of the plan of a synthetic motion: feet, posture, centre of pressure, height of the centre of
/// mass.
///
/// Plan frame: x forward at the start, y left, z up, floor z = 0, origin between the feet at the start.
/// Postures are relative to it through model axes (x left, y up, z forward): a positive first component
/// leans forward, a positive second turns left, a positive third leans right.
/// What it does not do: it does not place the pelvis, which follows from balance (whole_body_balance.h).
#pragma once

#include <vector>

#include "synth/inverse_kinematics.h"

namespace mimicx::synth {

inline constexpr double kSynthFps = 30.0;  ///< frames per second of every plan
/// Time of a frame, s.
inline double time_of(int frame) { return frame / kSynthFps; }

/// One value for the left side (0) and one for the right (1).
template <class T>
using PerSide = Array<T, 2>;

/// An arm by anatomical angles; all 0: straight down along the body.
struct ArmPosture {
  double forward = 0.0;   ///< raised to the front, rad
  double out = 0.0;       ///< raised to the side, rad
  double rotation = 0.0;  ///< upper arm about its own length, outward, rad
  double elbow = 0.0;     ///< flexion, rad
};

struct PlanFrame {
  double heading = 0.0;                ///< of the pelvis, rad
  Vector3d pelvis = Vector3d::Zero();  ///< tilt on top of the heading, rotation vector, rad
  Vector3d trunk = Vector3d::Zero();   ///< of the thorax relative to the pelvis, spread over the spine
  Vector3d head = Vector3d::Zero();    ///< of the head relative to the thorax, spread over neck and head
  PerSide<ArmPosture> arm;             ///< left, right
  PerSide<FootTarget> foot;            ///< left, right
  Eigen::Vector2d pressure = Eigen::Vector2d::Zero();  ///< centre of pressure, m; unused in flight
  double pressure_height = 0.0;                        ///< of the ground there, m
  double com_height = 0.0;                             ///< of the whole body, m
  bool flight = false;                                 ///< no foot touches the floor
};

/// Posture of someone standing at ease, the arms hanging clear of trunk and thighs.
PlanFrame relaxed_posture(const Character& character);

/// A posture at a time.
struct PostureKey {
  double time;
  PlanFrame posture;
};

/// Sets pelvis tilt, trunk, head, arms and height of the centre of mass to a minimum-jerk blend between keys;
/// feet and pressure do not change.
/// @param keys  in order of time
void hold_postures(const std::vector<PostureKey>& keys, double time, PlanFrame& frame);

}  // namespace mimicx::synth
