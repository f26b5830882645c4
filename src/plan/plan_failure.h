/// Why a plan failed, in words for the user.
#pragma once

#include <string>
#include <vector>

#include "control/plan.h"
#include "judge/reference_needs.h"
#include "rl/tracking/tracking_rollout.h"

namespace mimicx::plan {

/// "the plan fails at frame 132 (4.40 s): the left foot is 0.41 m from its reference; …". Then the
/// infeasible stretches of the reference within the second before (audit/pose_verdict.h), and the assistive
/// force that was needed to pass them (reference_needs.h). If the body held itself there, limb against limb
/// or trunk, the message names both. If neither is the cause, only the search failed, and the message says
/// so.
/// @param planned  the plan up to its failure, replayed
std::string failure_in_words(const control::Failure& failure, const audit::PoseNeeds& needs,
                             const PerFrame<Vector6d>& assistance,
                             const std::vector<rl::tracking::ActingForces>& planned);

}  // namespace mimicx::plan
