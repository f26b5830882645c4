/// Footsteps of the synthetic motions: feet and their load as functions of time.
///
/// What it does not do: pelvis, trunk and arms (gait.h), balance (whole_body_balance.h).
#pragma once

#include <vector>

#include "synth/min_jerk_track.h"
#include "synth/plan_frame.h"

namespace mimicx::synth {

/// A place in the air at which a moving foot comes to rest.
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
  double clearance = 0.0;             ///< height of the sole at mid-swing over the higher end, m
  bool running = false;               ///< leaves and meets the floor with speed, and meets it flat
  std::vector<FootVia> through = {};  ///< rests in the air, in order of time; `clearance` is unused then
  double ground = 0.0;                ///< height of the ground where it lands, m; not with `through`
};

/// A foot's motion; `pressure` is the point of the foot at which its load acts, m ahead of the ankle.
struct FootTracks {
  MinJerkTrack x, y, yaw, lift, heel_rise, toe_rise, pressure;
  MinJerkTrack ground;  ///< height of the ground on which it stands, m
  FootTarget at(double time) const;
};

/// Both feet and the share of the load on the left one, 0..1.
struct FeetTracks {
  PerSide<FootTracks> foot;
  MinJerkTrack load;
  double splay = 0.0;  ///< outward distance of the load from the foot's axis, m per m ahead of the ankle
};

/// Feet that stand still, equally loaded in their middle. @param start  `lift`: height of the ground, m
FeetTracks standing_feet(const Character& character, const PerSide<FootTarget>& start);

/// Feet that walk: a foot lands on the heel, becomes flat and rolls over the toes. The load changes feet
/// while both feet stand.
/// @param swings  in order of their starts; while both feet are in the air (running), the caller sets the
///                load and the pressure
/// @param settle  time in which the load moves from the middle to a foot before the first swing, and back at
///                the end, s
FeetTracks stepping_feet(const Character& character, const PerSide<FootTarget>& start,
                         const std::vector<FootSwing>& swings, double settle);

/// Sets the feet of a frame and its centre of pressure; the posture does not change. Where the feet stand at
/// different heights, the centre of pressure is on the line between them.
void place_feet(const FeetTracks& feet, double time, PlanFrame& frame);

/// Two feet on the y axis, toes turned out. @param half_width  distance of each ankle from the middle, m
PerSide<FootTarget> feet_apart(double half_width, double toes_out);

/// Half the distance of the ankles in the rest pose, m.
double rest_half_width(const Character& character);

/// Distance from hip to ankle along the stretched leg, m.
double leg_length(const Character& character);

/// Distance from the ankle to the toe points along the foot, m.
double forefoot_length(const Character& character);

/// Point at which the load of a flat foot acts, m ahead of the ankle.
double feet_middle(const Character& character);

/// `hold_postures` in all frames, and `place_feet`.
void hold_postures(const std::vector<PostureKey>& keys, const FeetTracks& feet, PerFrame<PlanFrame>& plan);

}  // namespace mimicx::synth
