/// The numbers that a run records of a motion, by the names of docs/metrics.md.
#pragma once

#include <string>

#include "audit/slip.h"
#include "core/named_values.h"
#include "motion/metrics.h"
#include "motion/reference.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::judge {

/// A clip at `rate` frames/s, as the metrics take it.
motion::MotionSamples samples_at(const motion::Clip& clip, double rate);

/// Of a simulated motion: its poses, and the floor's forces on it.
PerFrame<BodyPoses> poses_of(const Character& character, const rl::tracking::TrackingRollout& rollout);
audit::FloorWrenches ground_of(const rl::tracking::TrackingRollout& rollout);

/// By name, in the order of the tables.
NamedValues named_values(const motion::Metrics& metrics);

struct Scores {
  NamedValues values;
  bool success = false;
  std::string reason;  ///< why it is no success
};

/// A simulated motion against the reference that it follows. Success as docs/metrics.md defines it.
Scores score_simulated(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout);

struct InputScores {
  NamedValues values;
  audit::Slip slip;  ///< of its poses, with their best floor forces
};

/// The unprepared input (free joints, its own height) on its own scene, resampled to the reference's frame
/// rate, against the prepared reference, whose scene a fit may have moved; metrics against it are NaN if the
/// reference has another number of frames.
/// @param gravity  of the simulation, m/s²
InputScores score_input(const motion::Clip& input, const motion::Reference& reference, double gravity);

}  // namespace mimicx::judge
