/// Pose fit: corrects a motion without keypoints by its standing feet, the floor and balance.
///                                                    docs/method.md, "Keypoint fit", "Without keypoints"
///
/// The problem of the keypoint fit (keypoint_fit.h) without detections. Standing feet do not slip and are
/// level with the floor, soles are not below it, the zero-moment point lies within the feet, corrections are
/// small and smooth. That corrects legs and lean.
///
/// What it does not do: it hardly changes arms and head, and does not correct the person's place in the
/// world.
#pragma once

#include "fit/fit_config.h"
#include "fit/fit_report.h"
#include "motion/clip.h"

namespace mimicx::fit {

/// A motion trembles if the white noise of its joint rotations is above this, degrees per axis.
inline constexpr double kTremor = 0.3;
/// Feet that slide by less stand, m per frame at 30 fps.
inline constexpr double kStandingSlip = 0.0001;

/// Plants the feet of a motion that slides, and smooths a motion that trembles, as those of single-frame
/// estimators do. The less it slides the more its poses are believed (FitConfig::pose_slip). Keypoints and
/// shape do not change. A motion that does neither (`kTremor`, `kStandingSlip`), or with fewer than 4 frames,
/// is returned unchanged. Deterministic.
/// @param report  may be null
/// @throws DataError for values that are not finite
motion::Clip fit_poses(const motion::Clip& clip, const FitConfig& config, FitReport* report);

}  // namespace mimicx::fit
