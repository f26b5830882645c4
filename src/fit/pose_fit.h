/// Fit of poses alone: what standing feet, the floor and balance tell of a motion without keypoints.
///                                                    docs/method.md, "Keypoint fit", "Without keypoints"
///
/// The problem of the keypoint fit (keypoint_fit.h) without detections. Feet that stand do not slip and are
/// level with the floor, soles are not under it, the zero-moment point lies within the feet, corrections are
/// small and smooth. That finds errors of legs and lean that a pose alone does not show.
///
/// What it does not do: hardly anything for arms and head; nothing tells where the person is in the world.
#pragma once

#include "fit/fit_config.h"
#include "fit/fit_report.h"
#include "motion/clip.h"

namespace mimicx::fit {

/// White part of the joint rotations from which on a motion trembles, degrees per axis.
inline constexpr double kTremor = 0.3;

/// Plants the feet of a motion that slides, and calms one that trembles, as single-frame estimators leave it.
/// Keypoints and shape stay as they are. A motion that does neither (`kTremor`, FitConfig::pose_slip), or of
/// fewer than 4 frames, comes back unchanged. Deterministic. @param report  may be null
/// @throws DataError for values that are not finite
motion::Clip fit_poses(const motion::Clip& clip, const FitConfig& config, FitReport* report);

}  // namespace mimicx::fit
