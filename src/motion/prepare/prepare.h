/// Preparation: makes the reference that a simulated character follows of a clip.
///                                                                                docs/method.md §2, §9
///
/// What it does not do: no fit to keypoints (fit/keypoint_fit.h), no smoothing, no slopes.
#pragma once

#include <string>
#include <vector>

#include "motion/reference.h"

namespace mimicx::motion {

/// The changes that preparation made to a clip; every number is written into the manifest.
struct PreparationReport {
  double floor_shift_mm = 0;      ///< constant height added to put the motion on the floor
  double max_floor_shift_mm = 0;  ///< largest change of height of a frame, constant part included
  double hinge_residual_mean_mm = 0, hinge_residual_max_mm = 0;  ///< docs/method.md §2
  /// Distance of the joint positions from those of the input, on the body of the clip.
  double change_mean_mm = 0, change_max_mm = 0;
  double arms_moved_mm = 0;    ///< largest distance by which separate_arms moved a joint
  double feet_planted_mm = 0;  ///< largest distance by which plant_feet moved a joint
  int range_frames = 0;        ///< frames with a joint beyond its range (joint_ranges.h)
  double range_deg = 0;        ///< largest distance of a joint beyond its range
  int passages = 0;            ///< of limbs through the body that were led around it (self_passage.h)
  int passages_left = 0;       ///< for which no way around was found
  double foot_level_deg = 0;   ///< largest rotation by which level_feet turned a sole or toes
  int flagged_frames = 0;      ///< frames of glitches that were bridged (glitches.h)
  int limb_frames = 0;  ///< frames of glitches of single limbs (limb_glitches.h), summed over the limbs
  std::vector<std::string> notes;
};

struct PreparationConfig {
  double fps = 30.0;
  bool ranges = true;           ///< bring joints inside their ranges
  bool separate = true;         ///< lead limbs around the body, and move arms out of it
  bool sees = false;            ///< fitted to its keypoints: they help to decide where a limb goes around
  bool level_feet = true;       ///< remove errors in the pitch and roll of standing feet
  bool ground = true;           ///< align with the floor
  bool plant = true;            ///< put standing feet on one place of the floor, if `ground`
  bool bridge_flagged = true;   ///< interpolate over implausible frames
  PerFrame<bool> flagged = {};  ///< [frames of the clip] that were interpolated before; empty: none
};

/// Resamples the clip, bridges implausible frames, turns knees and elbows into hinges, brings joints into
/// their ranges, levels the feet, puts the motion on the floor and differentiates it. A motion that begins in
/// the air begins with the velocity of its flight.
/// @param report  may be null
/// @throws DataError for fewer than 2 frames or non-finite values.
Reference prepare_reference(const Clip& clip, const PreparationConfig& config, PreparationReport* report);

}  // namespace mimicx::motion
