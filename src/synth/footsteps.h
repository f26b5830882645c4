/// Footsteps of the synthetic motions: feet and their load as functions of time.
///
/// What it does not do: pelvis, trunk and arms (gait.h), balance (whole_body_balance.h).
#pragma once

#include <vector>

#include "synth/min_jerk_track.h"
#include "synth/plan_frame.h"

namespace mimicx::synth {

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

/// `hold_postures` in all frames, and `place_feet`.
void hold_postures(const std::vector<PostureKey>& keys, const FeetTracks& feet, PerFrame<PlanFrame>& plan);

}  // namespace mimicx::synth
