/// Parts of a motion that plans can follow where no plan follows all of it: its beginning, and stretches
/// after each failure.
///
/// A part is a stretch of the reference of one second or more that a simulated motion follows as a success
/// (docs/metrics.md). The first is the beginning of the motion that failed. Then the rest of the reference is
/// planned from half a second behind the loss, from the first frame around which the reference is feasible;
/// where that fails, too, its beginning is a part, and so on to the end, or until five attempts gave none.
/// These plans have no assisted stages and hardly go back, because they are cheap attempts.
///
/// What it does not do: parts are not joined, and they do not make the motion a success.
#pragma once

#include "plan/plan_settings.h"
#include "run/method.h"

namespace mimicx::plan {

/// Frames from the first on that are followed: before the first at which a body is farther from its
/// reference than a success allows, back to the last at which the joints are within the mean distance of a
/// success.
int followed_frames(const motion::Reference& reference, const rl::tracking::TrackingRollout& rollout);

/// @param failed  the motion that is no success
run::FollowedParts followed_parts(const motion::Reference& reference, const PlanningConfig& config,
                                  const rl::tracking::TrackingRollout& failed, const run::SequenceJob& job);

}  // namespace mimicx::plan
