/// What a kind of synthetic motion decides: footsteps, balance and posture over time.
///
/// Plan frame: x forward at the start, y left, z up, floor z = 0, origin between the feet at the start.
/// Postures are relative to it through model axes (x left, y up, z forward): a positive first component
/// leans forward, a positive second turns left, a positive third leans right.
/// What it does not do: place the pelvis. That follows from balance (synth/whole_body_balance.h).
#pragma once

#include <vector>

#include "synth/inverse_kinematics.h"
#include "synth/track.h"

namespace mimicx::synth {

inline constexpr double kSynthFps = 30.0;  ///< frames per second of every plan
/// Time of a frame, s.
inline double time_of(int frame) { return frame / kSynthFps; }

/// One value for the left side (0) and one for the right (1).
template <class T>
using PerSide = Array<T, 2>;

/// An arm by anatomy; all zero is straight down along the body.
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
  double com_height = 0.0;                             ///< of the whole body, m
  bool flight = false;                                 ///< no foot touches the floor
};

/// A place in the air at which a foot comes to rest on its way.
struct FootVia {
  double time;            ///< s
  Eigen::Vector2d place;  ///< as FootTarget's
  double lift;            ///< m
  double pitch = 0.0;     ///< toes up, rad; negative: heel up
};

/// One foot goes from where it stands to another place.
struct FootSwing {
  int side;                           ///< 0 left, 1 right
  double start, end;                  ///< leaves and meets the floor, s
  Eigen::Vector2d place;              ///< where it lands
  double yaw = 0.0;                   ///< how it lands
  double clearance = 0.0;             ///< height of the sole at mid-swing, m
  bool running = false;               ///< leaves and meets the floor with speed, and meets it flat
  std::vector<FootVia> through = {};  ///< where it rests in the air, in order of time; then no clearance
};

/// A foot's motion; `pressure` is where in the foot its share of the load acts, m ahead of the ankle.
struct FootTracks {
  MinJerkTrack x, y, yaw, lift, heel_rise, toe_rise, pressure;
  FootTarget at(double time) const;
};

/// Both feet and the share of the load on the left one, 0..1.
struct FeetTracks {
  PerSide<FootTracks> foot;
  MinJerkTrack load;
  double splay = 0.0;  ///< the line of the load leaves the foot's axis outward by this much per m ahead
};

/// Feet that stand where they are, equally loaded in their middle.
FeetTracks standing_feet(const Character& character, const PerSide<FootTarget>& start);

/// Feet that walk: heel first, flat, then over the toes; the load moves over while both feet stand.
/// @param swings  in order of their starts; where both feet are in the air (running), load and pressure are
///                the caller's to set
/// @param settle  time the load takes from the middle to a foot before the first swing and back at the end, s
FeetTracks stepping_feet(const Character& character, const PerSide<FootTarget>& start,
                         const std::vector<FootSwing>& swings, double settle);

/// Feet and the centre of pressure that follows from them. Leaves the posture alone.
void place_feet(const FeetTracks& feet, double time, PlanFrame& frame);

/// Two feet on the line y, toes turned out. @param half_width  of the middle to each ankle, m
PerSide<FootTarget> feet_apart(double half_width, double toes_out);

/// Half distance of the ankles with the legs straight down as in the rest pose, m.
double rest_half_width(const Character& character);

/// Distance from hip to ankle along the stretched leg, m.
double leg_length(const Character& character);

/// Distance from the ankle to the toe points along the foot, m.
double forefoot_length(const Character& character);

/// Where the load acts in a foot that stands flat, m ahead of the ankle.
double feet_middle(const Character& character);

/// Posture of someone standing at ease, the arms hanging clear of trunk and thighs.
PlanFrame relaxed_posture(const Character& character);

/// A posture to be held at a time.
struct PostureKey {
  double time;
  PlanFrame posture;
};

/// Minimum-jerk blends from key to key of pelvis tilt, trunk, head, arms and height of the centre of mass;
/// feet and pressure stay as they are.
/// @param keys  in order of time
void hold_postures(const std::vector<PostureKey>& keys, double time, PlanFrame& frame);

}  // namespace mimicx::synth
