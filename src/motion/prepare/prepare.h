/// Preparation: from a clip to the reference that a simulated character is asked to follow.
///                                                                                docs/method.md §2, §9
///
/// What it does not do: no fit to keypoints (fit/keypoint_fit.h), no smoothing, no model of stairs or slopes.
#pragma once

#include <string>
#include <vector>

#include "motion/reference.h"

namespace mimicx::motion {

/// What preparation did to a clip; every figure goes into the manifest.
struct PreparationReport {
  double floor_shift_mm = 0;      ///< static height added to put the motion on the floor
  double max_floor_shift_mm = 0;  ///< largest per-frame height change, static part included
  double hinge_residual_mean_mm = 0, hinge_residual_max_mm = 0;  ///< docs/method.md §2
  /// Distance of joint positions from the input's, both on the body of the clip.
  double change_mean_mm = 0, change_max_mm = 0;
  double arms_moved_mm =
      0;  ///< largest distance of a joint by separate_arms (motion/prepare/arm_separation.h)
  double foot_level_deg =
      0;                   ///< largest constant rotation that levelled a sole or toes (motion/prepare/feet.h)
  int flagged_frames = 0;  ///< frames of glitches (motion/prepare/glitches.h)
  int limb_frames =
      0;  ///< frames of single limbs' glitches (motion/prepare/limb_glitches.h), all limbs together
  std::vector<std::string> notes;
};

struct PreparationConfig {
  double fps = 30.0;
  bool separate = true;        ///< move arms out of the body
  bool level_feet = true;      ///< remove a constant error in the pitch and roll of standing feet
  bool ground = true;          ///< align with the floor
  bool bridge_flagged = true;  ///< interpolate over implausible frames
};

/// Resamples the clip, bridges implausible frames, turns knees and elbows into hinges, levels the feet, puts
/// the motion on the floor and differentiates it.
/// @param report  may be null
/// @throws DataError for fewer than 2 frames or non-finite values.
Reference prepare_reference(const Clip& clip, const PreparationConfig& config, PreparationReport* report);

}  // namespace mimicx::motion
